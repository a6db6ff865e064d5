/** Meshes of an asset, as three's loader makes them, with what shells and fins need. */

import { type BufferAttribute, Material, Mesh, type Object3D, SkinnedMesh } from 'three';
import type { GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import type { checkGeometry } from '../body/checkGeometry.ts';
import { ownAttributes } from '../body/shareGeometry.ts';
import type { finQuads } from '../fins/finQuads.ts';
import { FUR_EXTENSION, type FurAsset } from '../format.ts';
import { parts } from '../shells/parts/parts.ts';

/** Reader of the meshes of one asset. */
export class Meshes {
	readonly #parser: GLTFParser;
	readonly #asset: FurAsset;
	readonly #check: typeof checkGeometry | undefined;

	/** @param check of a geometry; undefined: it is trusted */
	constructor(parser: GLTFParser, asset: FurAsset, check: typeof checkGeometry | undefined) {
		this.#parser = parser;
		this.#asset = asset;
		this.#check = check;
	}

	/** The shells' mesh. */
	shells(): Promise<Mesh> {
		return this.#mesh(this.#asset.shells, 'shells');
	}

	/** The skin: a mesh, or a group of one for each material. */
	async skin(): Promise<{ object: Object3D; pieces: Mesh[] }> {
		const { skin: node } = this.#asset;
		const object = await this.#node(node);
		const meshes = object && (isMesh(object) || (object.children.length > 0 && object.children.every(isMesh)));
		if (!meshes) throw new Error(`${FUR_EXTENSION}/skin: node ${node} is no mesh`);
		const pieces = isMesh(object) ? [object] : (object.children as Mesh[]);
		for (const piece of pieces) {
			// It may have the shells' vertices, which have an end of their own.
			ownAttributes(piece.geometry);
			this.#check?.(`${FUR_EXTENSION}/skin`, piece.geometry, jointsOf(piece));
		}
		return { object, pieces };
	}

	/** The fins' mesh: that of their node, or made from edges of the shells. @param make of quads from edges */
	async quads(make: typeof finQuads): Promise<Mesh> {
		const { fins, edges, shells, length, height, drift, tiles = 1, roots } = this.#asset;
		if (!edges || fins !== undefined) return this.#mesh(fins as number, 'fins');
		const [surface, mask] = await Promise.all([
			this.#mesh(shells, 'shells'),
			this.#parser.json.accessors?.[edges.mask] && this.#parser.getDependency('accessor', edges.mask),
		]);
		if (!(mask?.array instanceof Uint8Array))
			throw new Error(`${FUR_EXTENSION}/edges: accessor ${edges.mask} has no bytes`);
		const tile = length / height / surface.scale.x;
		const places = { start: edges.start, tile, lean: drift.at(-1)?.[1] ?? 0, tiles, roots: roots?.scale };
		try {
			const quads = new Mesh(make(surface.geometry, mask.array, places));
			quads.position.copy(surface.position);
			quads.quaternion.copy(surface.quaternion);
			quads.scale.copy(surface.scale);
			return quads;
		} catch (error) {
			throw new Error(`${FUR_EXTENSION}/edges: ${(error as Error).message}`);
		}
	}

	/** The node's mesh, checked for the attributes that shells or fins need. */
	async #mesh(node: number, role: 'shells' | 'fins'): Promise<Mesh> {
		const { regions, roots } = this.#asset;
		const where = `${FUR_EXTENSION}/${role}`;
		const object = await this.#node(node);
		if (!isMesh(object)) throw new Error(`${where}: node ${node} is no mesh with one primitive`);
		for (const name of ['normal', 'tangent', 'uv', ...(role === 'fins' && roots ? ['uv1'] : [])]) {
			if (!object.geometry.hasAttribute(name)) throw new Error(`${where}: the mesh has no ${name}s`);
		}
		if (regions) parts.regions?.markFurs(object.geometry, regions.furs.length, where);
		object.geometry.morphAttributes = { ...object.geometry.morphAttributes, ...(await this.#tangents(node)) };
		this.#check?.(where, object.geometry, jointsOf(object));
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

	async #node(node: number): Promise<Object3D | undefined> {
		const object = this.#parser.json.nodes?.[node] && (await this.#parser.getDependency('node', node));
		object?.updateMatrix();
		return object;
	}
}

function isMesh(object: Object3D | undefined): object is Mesh {
	return object instanceof Mesh && object.material instanceof Material;
}

/** Number of joints that a mesh's vertices may name; undefined: it has none. */
function jointsOf(mesh: Mesh): number | undefined {
	return mesh instanceof SkinnedMesh ? mesh.skeleton.bones.length : undefined;
}
