/** Loading of golden assets from memory, over a network that may fail. */

import { readdirSync, readFileSync } from 'node:fs';
import { LoadingManager } from 'three';
import { type GLTF, GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { afterEach, beforeEach, vi } from 'vitest';
import { type FurLoaderOptions, FurLoaderPlugin } from '../../../../web/fur/FurLoaderPlugin.ts';

const BASE = 'http://files.test/';

// biome-ignore lint/suspicious/noExplicitAny: glTF that tests break
export type Json = any;

/** Files of a golden asset, by name; model.gltf parsed apart. */
export function golden(name = 'ptm-6'): { json: Json; files: Record<string, Uint8Array> } {
	const folder = new URL(`../../../golden/${name}/`, import.meta.url);
	const names = readdirSync(folder).filter((file) => /\.(bin|png)$/.test(file));
	const files = Object.fromEntries(names.map((file) => [file, new Uint8Array(readFileSync(new URL(file, folder)))]));
	return { json: JSON.parse(readFileSync(new URL('model.gltf', folder), 'utf8')), files };
}

/** Ends every test of a file with the network as it was; errors that three writes to the console are left out. */
export function restoreNetwork(): void {
	beforeEach(() => {
		vi.spyOn(console, 'error').mockReturnValue();
	});
	afterEach(() => {
		vi.restoreAllMocks();
		vi.unstubAllGlobals();
	});
}

/** Answer to the n-th request of a file, from 0; undefined: the file as it is. */
export type Answer = (file: string, n: number) => Response | Error | undefined;

/** Replaces the network; requests are counted by file. */
export function serve(files: Record<string, Uint8Array>, answer: Answer = () => undefined): Record<string, number> {
	const requests: Record<string, number> = {};
	vi.stubGlobal('ProgressEvent', Event);
	vi.stubGlobal('fetch', async ({ url, signal }: Request) => {
		const file = url.replace(BASE, '');
		requests[file] = (requests[file] ?? 0) + 1;
		signal.throwIfAborted();
		const got = answer(file, requests[file] - 1);
		if (got instanceof Error) throw got;
		return got ?? (files[file] ? new Response(files[file].slice()) : new Response('', { status: 404 }));
	});
	return requests;
}

/** Loads an asset of these files. */
export async function load(
	json: Json,
	{ manager = new LoadingManager(), ...options }: FurLoaderOptions & { manager?: LoadingManager } = {},
): Promise<GLTF> {
	const loader = new GLTFLoader(manager).register((parser) => new FurLoaderPlugin(parser, options));
	return loader.parseAsync(JSON.stringify(json), BASE);
}

/** The message with which an asset is refused, or 'loaded'. */
export async function refusal(json: Json, options?: Parameters<typeof load>[1]): Promise<string> {
	return load(json, options).then(
		() => 'loaded',
		(error: Error) => error.message,
	);
}
