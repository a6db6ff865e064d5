import {
	ClampToEdgeWrapping,
	Color,
	FileLoader,
	LoaderUtils,
	Material,
	Mesh,
	type MeshStandardMaterial,
	type Object3D,
	type Texture,
} from 'three';
import type { GLTF, GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { Fur } from './Fur.ts';
import { EXTENSION, type Fin, type FurAsset, type Pelt, parseFur, VERSION } from './format.ts';
import { checkLimits, type TextureLimits } from './limits.ts';
import { ALPHA_CUT } from './lod.ts';
import type { FurTextures } from './PeltMaterial.ts';
import { decodePlane, type Extent, mipSteps, type Texels, textureArray, type View } from './planes.ts';
import { Skin } from './skin.ts';

/**
 * Of the shells' planes. In close-ups of the bunny 2 is worth 1.4 dB against a supersampled picture, 4 and more 0.2 dB on
 * top. Fins gain nothing by it. Graphics cards hardly notice; of software rasterisers SwiftShader pays a quarter of the
 * frame for it, llvmpipe more than another frame.
 */
const ANISOTROPY = 2;

/** What a FurLoaderPlugin may be told. */
export interface FurLoaderOptions {
	/** What the GPU takes, by `limitsOf`: an asset that asks for more is refused before its planes are decoded. */
	limits?: TextureLimits;
	/** Most texels that are averaged along the slant in which a shell is seen, 1 to 16, where the GPU can; 2 by default. */
	anisotropy?: number;
	/** Called where the fur is of a newer version than `VERSION`, so that the skin stays alone; without it, a warning on the console. */
	newer?: (version: string) => void;
	/** Called with the loaded scene once its skin can be shown, in its own colours, before any plane has come. */
	skin?: (scene: Object3D) => void;
}

/**
 * Plugin for three's GLTFLoader: an asset with `FUR_ptm_shells` grows its fur, any other loads as ever.
 *
 *     const loader = new GLTFLoader().register((parser) => new FurLoaderPlugin(parser));
 *     const gltf = await loader.loadAsync('bunny/model.gltf');
 *     scene.add(gltf.scene);
 *
 * Of a newer version of the format the skin alone is shown, with a warning. Broken data rejects the promise with an
 * Error that says what is wrong.
 */
export class FurLoaderPlugin implements GLTFLoaderPlugin {
	/** The extension that it reads. */
	readonly name = EXTENSION;
	readonly #parser: GLTFParser;
	readonly #options: FurLoaderOptions;

	constructor(parser: GLTFParser, options: FurLoaderOptions = {}) {
		this.#parser = parser;
		this.#options = options;
	}

	/** Called by the loader: grows the fur. */
	async afterRoot(gltf: GLTF): Promise<void> {
		const extension = this.#parser.json.extensions?.[EXTENSION];
		if (!extension) return;
		const asset = parseFur(extension);
		if (!asset) {
			const warn = (version: string) =>
				console.warn(`${EXTENSION}: version ${version} is newer than ${VERSION}; showing the skin alone`);
			return (this.#options.newer ?? warn)(extension.version);
		}
		if (this.#options.limits) checkLimits(asset, this.#options.limits);
		gltf.userData.fur = await this.#grow(asset, gltf.scene);
	}

	async #grow(asset: FurAsset, scene: Object3D): Promise<Fur> {
		const pelt = asset.pelts[0] as Pelt;
		const withFins = asset.fins !== undefined && pelt.fin;
		const [{ skin, surface, colour }, textures, quads, finTextures] = await Promise.all([
			this.#body(asset, scene),
			this.#peltTextures(asset, pelt),
			withFins ? this.#mesh(asset.fins as number, 'fins') : undefined,
			withFins ? this.#finTextures(withFins) : undefined,
		]);
		const ground = {
			skin,
			colour,
			surface: surface.geometry,
			placement: surface,
			quads: quads?.geometry,
			quadPlacement: quads,
			finHeights: asset.tiles ?? 1,
		};
		return new Fur(asset, textures, finTextures, ground, () => {
			skin.dispose();
			for (const texture of Object.values({ ...textures })) texture?.dispose();
			for (const texture of Object.values({ ...finTextures })) texture?.dispose();
		});
	}

	/** What the fur stands on, as bright as without it until there is any. */
	async #body(asset: FurAsset, scene: Object3D): Promise<{ skin: Skin; surface: Mesh; colour: Color }> {
		const [surface, object] = await Promise.all([this.#mesh(asset.shells, 'shells'), this.#skin(asset.skin)]);
		const pieces = isMesh(object) ? [object] : (object.children as Mesh[]);
		// Shells that bring colours bring the whole of them: those of several materials, or of a picture.
		const own = pieces[0]?.material as MeshStandardMaterial | undefined;
		const colour = (!surface.geometry.hasAttribute('color') && own?.color) || new Color(1, 1, 1);
		const together = object.matrix.equals(surface.matrix);
		const skin = new Skin(object, pieces, together ? surface.geometry : undefined);
		this.#options.skin?.(scene);
		return { skin, surface, colour };
	}

	/** The node's mesh, with what the shaders of shells and fins can't do without. */
	async #mesh(node: number, role: 'shells' | 'fins'): Promise<Mesh> {
		const object = await this.#node(node);
		if (!isMesh(object)) throw new Error(`${EXTENSION}/${role}: node ${node} is no mesh with one primitive`);
		for (const name of ['normal', 'tangent', 'uv']) {
			if (!object.geometry.hasAttribute(name)) throw new Error(`${EXTENSION}/${role}: the mesh has no ${name}s`);
		}
		return object;
	}

	async #skin(node: number): Promise<Object3D> {
		const object = await this.#node(node);
		const meshes = object && (isMesh(object) || (object.children.length > 0 && object.children.every(isMesh)));
		if (!meshes) throw new Error(`${EXTENSION}/skin: node ${node} is no mesh`);
		return object;
	}

	async #node(node: number): Promise<Object3D | undefined> {
		const object = this.#parser.json.nodes?.[node] && (await this.#parser.getDependency('node', node));
		object?.updateMatrix();
		return object;
	}

	async #peltTextures({ size, layers, coefficients, height }: FurAsset, pelt: Pelt): Promise<FurTextures> {
		const extent = { width: size, height: size, layers };
		const textures = await this.#textures(pelt, extent, coefficients, { cut: ALPHA_CUT, rise: height });
		for (const texture of Object.values(textures))
			if (texture) texture.anisotropy = this.#options.anisotropy ?? ANISOTROPY;
		return textures;
	}

	/** Fins drop nothing by its coverage, and end at their tips. */
	async #finTextures(fin: Fin): Promise<FurTextures> {
		const { width, height } = fin;
		const textures = await this.#textures(fin, { width, height, layers: 1 }, fin.scale.length, { cut: 0, rise: 0 });
		for (const texture of Object.values(textures)) if (texture) texture.wrapT = ClampToEdgeWrapping;
		return textures;
	}

	async #textures(
		{ planes: [plane0, plane1], colour, direction }: Pick<Pelt, 'planes' | 'colour' | 'direction'>,
		extent: Extent,
		coefficients: number,
		view: View,
	): Promise<FurTextures> {
		// Those with coefficients first: the mip levels look for the coverage there.
		const files = await Promise.all(
			Object.entries({ plane0, plane1, colour, direction }).flatMap(([role, index]) =>
				index === undefined ? [] : this.#image(index).then((file) => ({ role, ...file })),
			),
		);
		// In order, whichever came first: of several bad planes the first is named.
		const images: { role: string; name: string; texels: Texels }[] = [];
		for (const { role, name, bytes } of files) {
			await turn();
			images.push({ role, name, texels: decodePlane(name, bytes, extent.width, extent.height * extent.layers) });
		}
		const planes = images.map(({ texels }) => texels);
		const mips = await unhurried(mipSteps(planes, extent, coefficients, view));
		const textures: Record<string, Texture> = {};
		for (const [p, { role, name }] of images.entries()) {
			const levels = mips.flatMap((level) => level[p] ?? []);
			textures[role] = textureArray(name, levels, extent, role === 'colour');
		}
		return textures as unknown as FurTextures;
	}

	/** The file of an image as it is: what the loader would make of it has gone through the browser's own decoder. */
	async #image(index: number): Promise<{ name: string; bytes: Uint8Array }> {
		const { json, options } = this.#parser;
		const definition = json.images?.[index];
		if (!definition) throw new Error(`${EXTENSION}/pelts: image ${index} is not in the file`);
		if (definition.bufferView !== undefined) {
			const bytes: ArrayBuffer = await this.#parser.getDependency('bufferView', definition.bufferView);
			return { name: definition.name ?? `image ${index}`, bytes: new Uint8Array(bytes) };
		}
		const url = LoaderUtils.resolveURL(definition.uri, options.path);
		const loader = new FileLoader(options.manager);
		loader.setResponseType('arraybuffer');
		loader.setRequestHeader(options.requestHeader);
		loader.setWithCredentials(options.crossOrigin === 'use-credentials');
		try {
			return { name: definition.uri, bytes: new Uint8Array((await loader.loadAsync(url)) as ArrayBuffer) };
		} catch (error) {
			throw new Error(`${definition.uri}: could not be loaded (${(error as Error).message})`);
		}
	}
}

/** Runs what would take long in steps, so that the page around it can draw meanwhile. */
async function unhurried<T>(steps: Generator<void, T>): Promise<T> {
	for (let step = steps.next(); ; step = steps.next()) {
		if (step.done) return step.value;
		await turn();
	}
}

/** Lets what else is waiting go first. Timers would be slowed down in a hidden page, messages are not. */
function turn(): Promise<void> {
	return new Promise((resolve) => {
		const { port1, port2 } = new MessageChannel();
		port1.onmessage = () => {
			port1.close();
			resolve();
		};
		port2.postMessage(undefined);
	});
}

function isMesh(object: Object3D | undefined): object is Mesh {
	return object instanceof Mesh && object.material instanceof Material;
}
