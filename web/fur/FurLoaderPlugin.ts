import {
	ClampToEdgeWrapping,
	Color,
	FileLoader,
	LoaderUtils,
	LoadingManager,
	Material,
	Mesh,
	type MeshStandardMaterial,
	type Object3D,
	type Texture,
} from 'three';
import type { GLTF, GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { Fur } from './Fur.ts';
import { EXTENSION, type Fin, type FurAsset, type Pelt, parseFur, VERSION } from './format.ts';
import { decodePlanes, type Layout, type PlaneFile, type Role } from './levels.ts';
import { checkLimits, type TextureLimits } from './limits.ts';
import { ALPHA_CUT } from './lod.ts';
import { type Cut, PeltStates } from './PeltStates.ts';
import { textureArray } from './planes.ts';
import { Skin } from './skin.ts';
import { statesOf } from './states.ts';
import type { FurTextures } from './texels.ts';

/**
 * Of the shells' planes. In close-ups of the bunny 2 is worth 1.4 dB against a supersampled picture, 4 and more 0.2 dB on
 * top. Fins gain nothing by it. Graphics cards hardly notice; of software rasterisers SwiftShader pays a quarter of the
 * frame for it, llvmpipe more than another frame.
 */
const ANISOTROPY = 2;

/** What a texture may have of layers on any GPU with WebGL2. */
const LEAST_LAYERS = 256;

/** Where a pelt, or its side view, says which images are its. */
type Stored = Pick<Pelt, 'planes' | 'colour' | 'direction'>;

/** An image's file as it is. */
interface StoredImage {
	name: string;
	bytes: Uint8Array;
}

/** What a FurLoaderPlugin may be told. */
export interface FurLoaderOptions {
	/** What the GPU takes, by `limitsOf`: an asset that asks for more is refused before its planes are decoded. */
	limits?: TextureLimits;
	/** Most texels that are averaged along the slant in which a shell is seen, 1 to 16, where the GPU can; 2 by default. */
	anisotropy?: number;
	/**
	 * Most states of a pelt, dry, wet and dirty, on the GPU at a time once they are wanted: all by default. Where a pelt has
	 * more (or more layers than a texture takes) it is two, those around the wetness of its wearers, and which they are changes
	 * with it; mud is then colour alone, without clumps of its own.
	 */
	states?: number;
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
		const [{ skin, surface, colour }, shells, quads, fins] = await Promise.all([
			this.#body(asset, scene),
			this.#shellCut(asset, pelt),
			withFins ? this.#mesh(asset.fins as number, 'fins') : undefined,
			withFins ? this.#finCut(asset, withFins) : undefined,
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
		const cuts = [shells, fins].filter((cut) => cut !== undefined) as [Cut, Cut?];
		const { states = Number.POSITIVE_INFINITY, limits = { layers: LEAST_LAYERS } } = this.#options;
		const worn = new PeltStates(asset, cuts, states, limits.layers);
		return new Fur(asset, worn, ground, () => {
			skin.dispose();
			worn.dispose();
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

	async #shellCut(asset: FurAsset, pelt: Pelt): Promise<Cut> {
		const { size, layers, coefficients, height } = asset;
		const extent = { width: size, height: size, layers };
		const layout = { extent, coefficients, view: { cut: ALPHA_CUT, rise: height } };
		const cut = await this.#cut(asset, pelt, layout, (state) => state);
		for (const texture of Object.values(cut.textures)) texture.anisotropy = this.#options.anisotropy ?? ANISOTROPY;
		return cut;
	}

	/** Fins drop nothing by its coverage, and end at their tips. */
	async #finCut(asset: FurAsset, fin: Fin): Promise<Cut> {
		const { width, height } = fin;
		const extent = { width, height, layers: 1 };
		const layout = { extent, coefficients: fin.scale.length, view: { cut: 0, rise: 0 } };
		const cut = await this.#cut(asset, fin, layout, (state) => state.fin as Fin);
		for (const texture of Object.values(cut.textures)) texture.wrapT = ClampToEdgeWrapping;
		return cut;
	}

	/** @param of its part of a state */
	async #cut(asset: FurAsset, worn: Stored, layout: Layout, of: (state: Pelt) => Stored): Promise<Cut> {
		const planes = this.#planes(worn).map(({ role, index }) => this.#image(index).then((file) => ({ role, ...file })));
		const textures: Record<string, Texture> = {};
		for (const { role, name, levels } of await decodePlanes(await Promise.all(planes), layout))
			textures[role] = textureArray(name, levels, layout.extent, role === 'colour');
		const { wet, dirty } = statesOf(asset);
		const files = new Map<Pelt, () => Promise<PlaneFile>[]>();
		for (const state of [...wet.slice(1), ...(dirty ? [dirty] : [])]) {
			const { planes, colour } = of(state);
			const stored = this.#planes({ planes, ...(!state.dirt && colour !== undefined && { colour }) });
			const wanted = await Promise.all(
				stored.map(async ({ role, index }) => {
					const file = await this.#later(index);
					return () => file().then((found) => ({ role, ...found }));
				}),
			);
			files.set(state, () => wanted.map((file) => file()));
		}
		const fetch = async (state: Pelt) => Promise.all(files.get(state)?.() ?? []);
		return { textures: textures as unknown as FurTextures, layout, fetch };
	}

	/** Those with coefficients first: the mip levels look for the coverage there. */
	#planes({ planes: [plane0, plane1], colour, direction }: Stored): { role: Role; index: number }[] {
		const roles = { plane0, plane1, colour, direction };
		return Object.entries(roles).flatMap(([role, index]) =>
			index === undefined ? [] : [{ role: role as Role, index }],
		);
	}

	/**
	 * The file of an image that is wanted later, if at all: nothing is fetched over the net for it now. What is in memory, in a
	 * .glb or at an address that its owner may take back, is kept.
	 */
	async #later(index: number): Promise<() => Promise<StoredImage>> {
		const { json, options } = this.#parser;
		const { uri } = json.images?.[index] ?? {};
		try {
			const url = uri && options.manager.resolveURL(LoaderUtils.resolveURL(uri, options.path));
			if (url && !/^(blob|data):/i.test(url)) return () => this.#file(uri, url, new LoadingManager());
			const image = await this.#image(index);
			return async () => image;
		} catch (error) {
			return () => Promise.reject(error);
		}
	}

	/** The file of an image as it is: what the loader would make of it has gone through the browser's own decoder. */
	async #image(index: number): Promise<StoredImage> {
		const { json, options } = this.#parser;
		const definition = json.images?.[index];
		if (!definition) throw new Error(`${EXTENSION}/pelts: image ${index} is not in the file`);
		if (definition.bufferView !== undefined) {
			const bytes: ArrayBuffer = await this.#parser.getDependency('bufferView', definition.bufferView);
			return { name: definition.name ?? `image ${index}`, bytes: new Uint8Array(bytes) };
		}
		return this.#file(definition.uri, LoaderUtils.resolveURL(definition.uri, options.path), options.manager);
	}

	async #file(name: string, url: string, manager: LoadingManager): Promise<StoredImage> {
		const { requestHeader, crossOrigin } = this.#parser.options;
		const loader = new FileLoader(manager);
		loader.setResponseType('arraybuffer');
		loader.setRequestHeader(requestHeader);
		loader.setWithCredentials(crossOrigin === 'use-credentials');
		try {
			return { name, bytes: new Uint8Array((await loader.loadAsync(url)) as ArrayBuffer) };
		} catch (error) {
			throw new Error(`${name}: could not be loaded (${(error as Error).message})`);
		}
	}
}

function isMesh(object: Object3D | undefined): object is Mesh {
	return object instanceof Mesh && object.material instanceof Material;
}
