import {
	type BufferAttribute,
	ClampToEdgeWrapping,
	Color,
	Material,
	Mesh,
	type MeshStandardMaterial,
	type Object3D,
	SkinnedMesh,
	type Texture,
} from 'three';
import type { GLTF, GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { loadRoots } from './body/roots/Roots.ts';
import { Skin } from './body/Skin.ts';
import { Fur } from './Fur.ts';
import { finQuads } from './fins/finQuads.ts';
import { type Fin, FUR_EXTENSION, FUR_VERSION, type FurAsset, fursOf, isNewer, type Pelt } from './format.ts';
import type { FurTextures } from './light/texels.ts';
import { checkLimits, type FurLimits } from './planes/furLimits.ts';
import { GltfFiles } from './planes/GltfFiles.ts';
import { isPacked, meshDecoder } from './planes/meshopt.ts';
import { decodePlanes, depthOf, type Layout, type PlaneFile, type Role } from './planes/mipLevels.ts';
import { type Cut, PeltStates } from './planes/PeltStates.ts';
import { readOneLevel, textureArray } from './planes/planes.ts';
import { statesOf } from './planes/states.ts';
import { ALPHA_CUT } from './shells/lod.ts';
import { markFurs } from './shells/regions/markFurs.ts';

/**
 * Anisotropy of the shells' planes. In close-ups of the bunny 2 gains 1.4 dB against a supersampled picture, 4 and more
 * another 0.2 dB. Fins gain nothing. Graphics cards hardly notice; SwiftShader pays a quarter of the frame, llvmpipe more
 * than another frame.
 */
const ANISOTROPY = 2;

/** Layers per texture that every GPU with WebGL2 allows. */
const MIN_LAYERS = 256;

/** Image indices of a pelt or fin. */
type Stored = Pick<Pelt, 'planes' | 'colour' | 'direction'>;

/** Options of FurLoaderPlugin. */
export interface FurLoaderOptions {
	/**
	 * Checks the file before it is shown; true by default. False for models that are known to be sound, as by `furbake
	 * validate`: the checks are then not fetched, and what a broken file does is not told.
	 */
	check?: boolean;
	/** Limits of the GPU, by `furLimits`: a larger asset is refused before its planes are decoded. */
	limits?: FurLimits;
	/** Anisotropy of the shells' planes, texels, 1 to 16 as far as the GPU allows; 2 by default. */
	anisotropy?: number;
	/**
	 * Most states of a pelt (dry, wet, dirty) on the GPU at a time; all by default. A pelt with more states, or more layers
	 * than a texture takes, keeps two: those around its furs' present wetness. Mud is then colour alone, without clumps.
	 */
	states?: number;
	/** Called for fur of a newer version than `FUR_VERSION`, of which only the skin is shown; a console warning by default. */
	newer?: (version: string) => void;
	/** Called with the loaded scene once its skin can be shown, in its own colours, before any plane has been fetched. */
	skin?: (scene: Object3D) => void;
}

/**
 * Plugin for three's GLTFLoader: an asset with `FUR_ptm_shells` grows its fur, any other loads as ever.
 *
 *     const loader = new GLTFLoader().register((parser) => new FurLoaderPlugin(parser));
 *     const gltf = await loader.loadAsync('bunny/model.gltf');
 *     scene.add(gltf.scene);
 *
 * A newer version of the format shows the skin alone, with a warning. Broken data rejects the promise with an
 * Error that says what is wrong.
 */
export class FurLoaderPlugin implements GLTFLoaderPlugin {
	/** Name of the extension. */
	readonly name = FUR_EXTENSION;
	readonly #parser: GLTFParser;
	readonly #options: FurLoaderOptions;
	readonly #files: GltfFiles;
	#checks: typeof import('./checks.ts') | undefined;

	constructor(parser: GLTFParser, options: FurLoaderOptions = {}) {
		this.#parser = parser;
		this.#options = options;
		this.#files = new GltfFiles(parser);
		const packed = isPacked(parser.json);
		if (packed) parser.options.meshoptDecoder ??= meshDecoder();
		if (!this.#extension) return;
		if (options.check !== false) this.#checkFirst();
		// The loader itself fetches the buffer of compressed views: it has to arrive whole, too.
		if (packed) parser.loadBuffer = (index) => this.#files.buffer(index);
	}

	get #extension() {
		return this.#parser.json.extensions?.[FUR_EXTENSION];
	}

	/** Lets three's loader wait for the checks: it would read a broken glTF without a look. */
	#checkFirst(): void {
		const parser = this.#parser;
		const parse = parser.parse.bind(parser);
		parser.parse = (onLoad, onError) => {
			const checked = import('./checks.ts').then((checks) => {
				checks.checkModel(parser.json);
				this.#checks = checks;
			});
			checked.then(() => parse(onLoad, onError), onError);
		};
	}

	/** Called by the loader: reads from a buffer that has arrived whole. */
	loadBufferView(index: number): Promise<ArrayBuffer> | null {
		if (!this.#extension) return null;
		return this.#files.bufferView(index);
	}

	/** Called by the loader: grows the fur. */
	async afterRoot(gltf: GLTF): Promise<void> {
		const extension = this.#extension;
		if (!extension) return;
		if (isNewer(extension)) {
			const warn = (version: string) =>
				console.warn(`${FUR_EXTENSION}: version ${version} is newer than ${FUR_VERSION}; showing the skin alone`);
			return (this.#options.newer ?? warn)(extension.version);
		}
		const asset: FurAsset = extension;
		if (this.#options.limits) checkLimits(asset, this.#options.limits);
		gltf.userData.fur = await this.#grow(asset, gltf.scene);
	}

	async #grow(asset: FurAsset, scene: Object3D): Promise<Fur> {
		const pelt = asset.pelts[0] as Pelt;
		const withFins = (asset.fins ?? asset.edges) !== undefined && pelt.fin;
		const [{ skin, surface, colour }, roots, shells, quads, fins] = await Promise.all([
			this.#body(asset, scene),
			loadRoots(this.#parser, asset),
			this.#shellCut(asset),
			withFins ? this.#quads(asset) : undefined,
			withFins ? this.#finCut(asset, withFins) : undefined,
		]);
		const ground = {
			skin,
			colour,
			roots,
			surface: surface.geometry,
			placement: surface,
			quads: quads?.geometry,
			quadPlacement: quads,
			finHeights: asset.tiles ?? 1,
		};
		const cuts = [shells, fins].filter((cut) => cut !== undefined) as [Cut, Cut?];
		const { states = Number.POSITIVE_INFINITY, limits = { layers: MIN_LAYERS } } = this.#options;
		const worn = new PeltStates(asset, cuts, states, limits.layers);
		return new Fur(asset, worn, ground, 'body');
	}

	/** Skin, shells' mesh and base colour; the skin stays unshaded until there is fur. */
	async #body(asset: FurAsset, scene: Object3D): Promise<{ skin: Skin; surface: Mesh; colour: Color }> {
		const [surface, object] = await Promise.all([
			this.#mesh(asset.shells, 'shells', asset.regions),
			this.#skin(asset.skin),
		]);
		const pieces = isMesh(object) ? [object] : (object.children as Mesh[]);
		for (const piece of pieces) this.#checks?.checkGeometry(`${FUR_EXTENSION}/skin`, piece.geometry, jointsOf(piece));
		// Vertex colours of the shells already contain the base colour of every material or picture.
		const own = pieces[0]?.material as MeshStandardMaterial | undefined;
		const colour = (!surface.geometry.hasAttribute('color') && own?.color) || new Color(1, 1, 1);
		const together = object.matrix.equals(surface.matrix);
		const skin = new Skin(object, pieces, together ? surface.geometry : undefined);
		this.#options.skin?.(scene);
		return { skin, surface, colour };
	}

	/** The fins' mesh: that of their node, or made from edges of the shells. */
	async #quads(asset: FurAsset): Promise<Mesh> {
		const { fins, edges, shells, length, height, drift, tiles = 1, regions } = asset;
		if (!edges || fins !== undefined) return this.#mesh(fins as number, 'fins', regions);
		const [surface, mask] = await Promise.all([
			this.#mesh(shells, 'shells'),
			this.#parser.json.accessors?.[edges.mask] && this.#parser.getDependency('accessor', edges.mask),
		]);
		if (!(mask?.array instanceof Uint8Array))
			throw new Error(`${FUR_EXTENSION}/edges: accessor ${edges.mask} has no bytes`);
		const tile = length / height / surface.scale.x;
		const places = { start: edges.start, tile, lean: drift.at(-1)?.[1] ?? 0, tiles, roots: asset.roots?.scale };
		try {
			const quads = new Mesh(finQuads(surface.geometry, mask.array, places));
			quads.position.copy(surface.position);
			quads.quaternion.copy(surface.quaternion);
			quads.scale.copy(surface.scale);
			return quads;
		} catch (error) {
			throw new Error(`${FUR_EXTENSION}/edges: ${(error as Error).message}`);
		}
	}

	/** The node's mesh, checked for the attributes that shells or fins need. */
	async #mesh(node: number, role: 'shells' | 'fins', regions?: FurAsset['regions']): Promise<Mesh> {
		const object = await this.#node(node);
		if (!isMesh(object)) throw new Error(`${FUR_EXTENSION}/${role}: node ${node} is no mesh with one primitive`);
		const roots = role === 'fins' && this.#extension.roots;
		for (const name of ['normal', 'tangent', 'uv', ...(roots ? ['uv1'] : [])]) {
			if (!object.geometry.hasAttribute(name)) throw new Error(`${FUR_EXTENSION}/${role}: the mesh has no ${name}s`);
		}
		if (regions) markFurs(object.geometry, regions.furs.length, `${FUR_EXTENSION}/${role}`);
		object.geometry.morphAttributes = { ...object.geometry.morphAttributes, ...(await this.#tangents(node)) };
		this.#checks?.checkGeometry(`${FUR_EXTENSION}/${role}`, object.geometry, jointsOf(object));
		return object;
	}

	/** Changes of the tangents by morph targets, which three leaves out. */
	async #tangents(node: number): Promise<Record<string, BufferAttribute[]>> {
		const { nodes, meshes } = this.#parser.json;
		const targets: { TANGENT?: number }[] = meshes[nodes[node].mesh].primitives[0].targets ?? [];
		if (!targets.some(({ TANGENT }) => TANGENT !== undefined)) return {};
		return {
			tangent: await Promise.all(
				targets.map(({ TANGENT }) => this.#parser.getDependency('accessor', TANGENT as number)),
			),
		};
	}

	async #skin(node: number): Promise<Object3D> {
		const object = await this.#node(node);
		const meshes = object && (isMesh(object) || (object.children.length > 0 && object.children.every(isMesh)));
		if (!meshes) throw new Error(`${FUR_EXTENSION}/skin: node ${node} is no mesh`);
		return object;
	}

	async #node(node: number): Promise<Object3D | undefined> {
		const object = this.#parser.json.nodes?.[node] && (await this.#parser.getDependency('node', node));
		object?.updateMatrix();
		return object;
	}

	async #shellCut(asset: FurAsset): Promise<Cut> {
		const { size, layers, coefficients, height } = asset;
		const extent = { width: size, height: size, layers };
		const layout = { extent, coefficients, view: { cut: ALPHA_CUT, rise: height }, ...heightsOf(asset) };
		const cut = await this.#cut(asset, layout, (state) => state);
		for (const texture of Object.values(cut.textures)) texture.anisotropy = this.#options.anisotropy ?? ANISOTROPY;
		return cut;
	}

	/** Planes of the fins: no alpha cut, clamped at the tips. */
	async #finCut(asset: FurAsset, fin: Fin): Promise<Cut> {
		const { width, height } = fin;
		const extent = { width, height, layers: 1 };
		const layout = { extent, coefficients: fin.scale.length, view: { cut: 0, rise: 0 }, ...heightsOf(asset) };
		const cut = await this.#cut(asset, layout, (state) => state.fin as Fin);
		for (const texture of Object.values(cut.textures)) texture.wrapT = ClampToEdgeWrapping;
		return cut;
	}

	/** @param partOf the cut's part of a state */
	async #cut(asset: FurAsset, layout: Layout, partOf: (state: Pelt) => Stored): Promise<Cut> {
		const furs = fursOf(asset);
		const planes = furs.flatMap(({ pelts }, fur) =>
			this.#planes(partOf(pelts[0] as Pelt)).map(({ role, index }) =>
				this.#files.image(index).then((file) => ({ role, fur, ...file })),
			),
		);
		const textures: Record<string, Texture> = {};
		for (const { role, name, levels } of await decodePlanes(await Promise.all(planes), layout))
			textures[role] = textureArray(name, levels, { ...layout.extent, layers: depthOf(layout) }, role === 'colour');
		readOneLevel(textures);
		const { wet, dirty } = statesOf(asset);
		const files = new Map<Pelt, () => Promise<PlaneFile>[]>();
		for (const state of [...wet.slice(1), ...(dirty ? [dirty] : [])]) {
			const wanted = await Promise.all(
				furs.flatMap(({ pelts }, fur) => {
					const { planes, colour } = partOf(pelts[asset.pelts.indexOf(state)] as Pelt);
					const stored = this.#planes({ planes, ...(!state.dirt && colour !== undefined && { colour }) });
					return stored.map(async ({ role, index }) => {
						const file = await this.#files.later(index);
						return () => file().then((found) => ({ role, fur, ...found }));
					});
				}),
			);
			files.set(state, () => wanted.map((file) => file()));
		}
		const fetch = async (state: Pelt) => Promise.all(files.get(state)?.() ?? []);
		return { textures: textures as unknown as FurTextures, layout, fetch };
	}

	/** Planes with coefficients first: the mip levels read the coverage there. */
	#planes({ planes: [plane0, plane1], colour, direction }: Stored): { role: Role; index: number }[] {
		const roles = { plane0, plane1, colour, direction };
		return Object.entries(roles).flatMap(([role, index]) =>
			index === undefined ? [] : [{ role: role as Role, index }],
		);
	}
}

/** Heights of several furs over the coat's. */
function heightsOf(asset: FurAsset): Pick<Layout, 'heights'> {
	const { regions, height } = asset;
	return regions ? { heights: [1, ...regions.furs.map((fur) => fur.height / height)] } : {};
}

function isMesh(object: Object3D | undefined): object is Mesh {
	return object instanceof Mesh && object.material instanceof Material;
}

/** Number of joints that a mesh's vertices may name; undefined: it has none. */
function jointsOf(mesh: Mesh): number | undefined {
	return mesh instanceof SkinnedMesh ? mesh.skeleton.bones.length : undefined;
}
