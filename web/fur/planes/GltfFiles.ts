/** Files of a glTF, as its loader is set to fetch them, checked to be whole. */

import { LoaderUtils, LoadingManager } from 'three';
import type { GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { FUR_EXTENSION } from '../format.ts';
import { download } from './download.ts';
import { isWholePng } from './png.ts';

/** File of an image, undecoded. */
export interface StoredImage {
	name: string;
	bytes: Uint8Array;
}

/** Buffers and images of one file in loading. */
export class GltfFiles {
	readonly #parser: GLTFParser;
	readonly #buffers: Promise<ArrayBuffer>[] = [];

	constructor(parser: GLTFParser) {
		this.#parser = parser;
	}

	/** Bytes of a buffer view, from a buffer that has arrived whole. */
	bufferView(index: number): Promise<ArrayBuffer> {
		const { buffer, byteOffset = 0, byteLength } = this.#parser.json.bufferViews[index];
		return this.buffer(buffer).then((bytes) => bytes.slice(byteOffset, byteOffset + byteLength));
	}

	/** A buffer that has arrived whole. */
	buffer(index: number): Promise<ArrayBuffer> {
		this.#buffers[index] ??= this.#fetch(index);
		return this.#buffers[index];
	}

	async #fetch(index: number): Promise<ArrayBuffer> {
		const { json, options, extensions } = this.#parser;
		const { uri, byteLength } = json.buffers[index];
		const name = nameOf(uri) ?? `buffer ${index}`;
		const isWhole = (bytes: ArrayBuffer) => bytes.byteLength >= byteLength;
		const bytes: ArrayBuffer | undefined =
			uri === undefined
				? extensions.KHR_binary_glTF?.body
				: await this.#download(name, LoaderUtils.resolveURL(uri, options.path), options.manager, isWhole);
		const got = bytes?.byteLength ?? 0;
		if (!bytes || got < byteLength) throw new Error(`${name}: got ${got} bytes, expected ${byteLength}`);
		return bytes;
	}

	/**
	 * Loader of an image that may be needed later; nothing is fetched over the network now. Data in memory (a .glb, a blob
	 * address that its owner may revoke) is kept.
	 */
	async later(index: number): Promise<() => Promise<StoredImage>> {
		const { json, options } = this.#parser;
		const { uri } = json.images?.[index] ?? {};
		try {
			const url = uri && options.manager.resolveURL(LoaderUtils.resolveURL(uri, options.path));
			if (url && !/^(blob|data):/i.test(url)) return () => this.#file(uri, url, new LoadingManager());
			const image = await this.image(index);
			return async () => image;
		} catch (error) {
			return () => Promise.reject(error);
		}
	}

	/** File of an image, undecoded: the loader's own textures have gone through the browser's decoder. */
	async image(index: number): Promise<StoredImage> {
		const { json, options } = this.#parser;
		const definition = json.images?.[index];
		if (!definition) throw new Error(`${FUR_EXTENSION}/pelts: image ${index} is not in the file`);
		if (definition.bufferView !== undefined) {
			const bytes: ArrayBuffer = await this.#parser.getDependency('bufferView', definition.bufferView);
			return { name: definition.name ?? `image ${index}`, bytes: new Uint8Array(bytes) };
		}
		const { uri, name = `image ${index}` } = definition;
		return this.#file(nameOf(uri) ?? name, LoaderUtils.resolveURL(uri, options.path), options.manager);
	}

	async #file(name: string, url: string, manager: LoadingManager): Promise<StoredImage> {
		const bytes = await this.#download(name, url, manager, (bytes) => isWholePng(new Uint8Array(bytes)));
		return { name, bytes: new Uint8Array(bytes) };
	}

	async #download(
		name: string,
		url: string,
		manager: LoadingManager,
		isWhole: (bytes: ArrayBuffer) => boolean,
	): Promise<ArrayBuffer> {
		const { requestHeader, crossOrigin } = this.#parser.options;
		try {
			return await download(
				{ url, requestHeader, withCredentials: crossOrigin === 'use-credentials', isWhole },
				manager,
			);
		} catch (error) {
			throw new Error(`${name}: could not be loaded (${(error as Error).message})`);
		}
	}
}

/** Name of a file; undefined for data in the address itself. */
function nameOf(uri: string | undefined): string | undefined {
	return uri?.startsWith('data:') ? undefined : uri;
}
