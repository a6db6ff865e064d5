import { Color, FileLoader, LoaderUtils, Material, Mesh, type MeshStandardMaterial, type Texture } from 'three';
import type { GLTF, GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { ALPHA_CUT, FurMaterial } from './FurMaterial.ts';
import { EXTENSION, type FurAsset, type Pelt, parseFur, VERSION } from './format.ts';
import { decodePlane, mipLevels, textureArray } from './planes.ts';
import { FurShells } from './shells.ts';

/** How much of the roots' colour the skin shows: it lies in the shadow of all the fur above it. */
const SKIN_SHADE = 0.35;

/** The fur of a loaded asset; find it as `gltf.userData.fur`. */
export interface Fur {
	asset: FurAsset;
	/** Drawn in the scene beside the skin. */
	shells: FurShells;
	skin: Mesh;
	/** Frees geometry, material and textures. */
	dispose(): void;
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
	readonly name = EXTENSION;
	readonly #parser: GLTFParser;

	constructor(parser: GLTFParser) {
		this.#parser = parser;
	}

	async afterRoot(gltf: GLTF): Promise<void> {
		const extension = this.#parser.json.extensions?.[EXTENSION];
		if (!extension) return;
		const asset = parseFur(extension);
		if (!asset) {
			console.warn(`${EXTENSION}: version ${extension.version} is newer than ${VERSION}; showing the skin alone`);
			return;
		}
		gltf.userData.fur = await this.#grow(asset);
	}

	async #grow(asset: FurAsset): Promise<Fur> {
		const pelt = asset.pelts[0] as Pelt;
		const [surface, skin, textures] = await Promise.all([
			this.#mesh(asset.shells, 'shells'),
			this.#mesh(asset.skin, 'skin'),
			this.#textures(asset, pelt),
		]);
		for (const name of ['normal', 'tangent', 'uv']) {
			if (!surface.geometry.hasAttribute(name)) throw new Error(`${EXTENSION}/shells: the mesh has no ${name}s`);
		}
		const own = skin.material as MeshStandardMaterial;
		const base = own.color ?? new Color(1, 1, 1);
		const [plane0, plane1] = textures.planes;
		if (!plane0) throw new Error(`${EXTENSION}/pelts: ${pelt.name} has no planes`);
		const material = new FurMaterial(asset, { plane0, plane1, colour: textures.colour }, { skinColour: base.clone() });
		const shells = new FurShells(surface.geometry, surface, asset, material);

		const dark = own.clone();
		dark.color?.copy(base).multiply(new Color(...asset.ramp.root).multiplyScalar(SKIN_SHADE));
		skin.material = dark;
		skin.parent?.add(shells);

		return {
			asset,
			shells,
			skin,
			dispose() {
				shells.removeFromParent();
				shells.dispose();
				material.dispose();
				dark.dispose();
				skin.geometry.dispose();
				for (const texture of [...textures.planes, textures.colour]) texture?.dispose();
			},
		};
	}

	async #mesh(node: number, role: string): Promise<Mesh> {
		const object = this.#parser.json.nodes?.[node] && (await this.#parser.getDependency('node', node));
		if (!(object instanceof Mesh) || !(object.material instanceof Material)) {
			throw new Error(`${EXTENSION}/${role}: node ${node} is no mesh with one primitive`);
		}
		return object;
	}

	async #textures(asset: FurAsset, pelt: Pelt): Promise<{ planes: Texture[]; colour: Texture | undefined }> {
		const { size, layers, coefficients } = asset;
		const images = pelt.colour === undefined ? pelt.planes : [...pelt.planes, pelt.colour];
		const planes = await Promise.all(
			images.map(async (index) => {
				const { name, bytes } = await this.#image(index);
				return { name, texels: decodePlane(name, bytes, size, layers) };
			}),
		);
		const mips = mipLevels(
			planes.map(({ texels }) => texels),
			size,
			layers,
			coefficients,
			ALPHA_CUT,
		);
		const textures = planes.map(({ name }, p) => {
			const levels = mips.flatMap((level) => level[p] ?? []);
			return textureArray(name, levels, size, layers, p >= pelt.planes.length);
		});
		return { planes: textures.slice(0, pelt.planes.length), colour: textures[pelt.planes.length] };
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
