/** Quads of the fins, from the edges of the shells' mesh on which they stand. */

import { BufferGeometry, Float32BufferAttribute, Vector3 } from 'three';
import { EdgeFaces } from './EdgeFaces.ts';

/** Share of a tile by which each fin begins further on than the one before it: the golden section. */
const GOLDEN = (Math.sqrt(5) - 1) / 2;

/** Where fins are in their tile. */
export interface FinPlaces {
	/** Where the first fin begins, tiles. */
	start: number;
	/** Width of a tile, units of the surface. */
	tile: number;
	/** How far hairs lean along growing u at their tips, tiles. */
	lean: number;
	/** Tiles that a texture coordinate of 1 stands for. */
	tiles: number;
}

/** Numbers per vertex of what `FurFins` needs. */
const SIZES = { position: 3, normal: 3, tangent: 4, uv: 2, _fur: 4, _edge: 4, color: 3 };

/**
 * Four vertices per edge: root, root, tip, tip, first end before second.
 *
 * @param surface the shells' geometry
 * @param pairs vertices of it, two per edge
 * @throws Error where a pair is no edge of a face
 */
export function finQuads(surface: BufferGeometry, pairs: ArrayLike<number>, places: FinPlaces): BufferGeometry {
	const { start, tile, lean, tiles } = places;
	const [position, count] = [surface.getAttribute('position'), pairs.length / 2];
	const known = Array.prototype.every.call(pairs, (vertex: number) => vertex < position.count);
	if (count % 1 || !known) throw new Error(`got ${pairs.length} vertices, expected pairs of less than ${position.count}`);
	const quads = new BufferGeometry();
	for (const [name, size] of Object.entries(SIZES)) {
		if (name !== 'color' || surface.hasAttribute(name))
			quads.setAttribute(name, new Float32BufferAttribute(count * 4 * size, size));
	}
	const faces = new EdgeFaces(surface);
	const roots = [new Root(surface, quads), new Root(surface, quads)] as const;
	const [along, laid, one, two] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
	for (let edge = 0; edge < count; edge++) {
		const ends = [pairs[edge * 2] as number, pairs[edge * 2 + 1] as number] as const;
		const [first, second] = roots;
		first.read(ends[0]);
		second.read(ends[1]);
		along.subVectors(second.place, first.place);
		const length = along.length() / tile;
		along.normalize();
		laid.addVectors(first.across, second.across).normalize();
		const sheared = lean * (1 - Math.abs(along.dot(laid)));
		const begin = (start + GOLDEN * edge) % 1;
		faces.normals(...ends, one, two);
		for (const [end, root] of roots.entries()) {
			const u = begin + end * length;
			root.write(4 * edge + end, along, one, two, u / tiles, 0);
			root.write(4 * edge + end + 2, along, one, two, (u + sheared) / tiles, 1 / tiles);
		}
	}
	quads.setIndex(Array.from({ length: 6 * count }, (_, i) => 4 * Math.floor(i / 6) + ([0, 1, 3, 0, 3, 2][i % 6] as number)));
	return quads;
}

/** An end of an edge: a vertex of the shells, and its copies in a fin. */
class Root {
	readonly place = new Vector3();
	/** Direction in which v grows. */
	readonly across = new Vector3();
	readonly #normal = new Vector3();
	readonly #comb = new Vector3();
	readonly #spare = [new Vector3(), new Vector3()] as const;
	#vertex = 0;

	constructor(
		readonly surface: BufferGeometry,
		readonly quads: BufferGeometry,
	) {}

	/** Reads a vertex of the shells. */
	read(vertex: number): void {
		const { position, normal, tangent, _comb } = this.surface.attributes;
		if (!position || !normal || !tangent) return;
		this.#vertex = vertex;
		this.place.fromBufferAttribute(position, vertex);
		this.#normal.fromBufferAttribute(normal, vertex).normalize();
		const t = this.#comb.fromBufferAttribute(tangent, vertex).normalize();
		this.across.crossVectors(this.#normal, t).multiplyScalar(tangent.getW(vertex)).normalize();
		t.multiplyScalar(_comb?.getX(vertex) ?? 0).addScaledVector(this.across, _comb?.getY(vertex) ?? 0);
	}

	/**
	 * Writes a vertex of a fin.
	 *
	 * @param along unit, the edge; `one`, `two`: normals of its faces
	 */
	write(at: number, along: Vector3, one: Vector3, two: Vector3, u: number, v: number): void {
		const { position, normal, tangent, uv, _fur, _edge, color } = this.quads.attributes;
		const { _fur: fur, color: colour } = this.surface.attributes;
		const [vertex, n] = [this.#vertex, this.#normal];
		position?.setXYZ(at, ...this.place.toArray());
		normal?.setXYZ(at, ...n.toArray());
		tangent?.setXYZW(at, along.x, along.y, along.z, 1);
		uv?.setXY(at, u, v);
		_fur?.setXYZW(at, 1, fur?.getY(vertex) ?? 1, fur?.getZ(vertex) ?? 1, fur?.getW(vertex) ?? 0);
		if (colour) color?.setXYZ(at, colour.getX(vertex), colour.getY(vertex), colour.getZ(vertex));
		// The comb, along the edge made perpendicular to the normal, and across.
		const [upright, aside] = this.#spare;
		aside.crossVectors(along, n).normalize();
		const comb = [this.#comb.dot(upright.crossVectors(n, aside)), this.#comb.dot(aside)] as const;
		// Angles about the edge, from the normal made perpendicular to it.
		upright.copy(n).addScaledVector(along, -along.dot(n)).normalize();
		aside.crossVectors(along, upright);
		const angle = (face: Vector3) => Math.atan2(face.dot(aside), face.dot(upright)) / Math.PI;
		_edge?.setXYZW(at, angle(one), angle(two), ...comb);
	}
}
