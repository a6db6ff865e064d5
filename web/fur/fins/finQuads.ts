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
	/** Coordinates of the picture of the roots per tile; undefined: there is none. */
	roots?: readonly [number, number] | undefined;
}

/** Numbers per vertex of what `FurFins` needs. */
const SIZES = {
	...{ position: 3, normal: 3, tangent: 4, uv: 2, _fur: 4, _edge: 4 },
	...{ color: 3, skinIndex: 4, skinWeight: 4, uv1: 2 },
};

/** Those that only some surfaces have, copied from their vertices. */
const COPIED: readonly string[] = ['color', 'skinIndex', 'skinWeight'];

/**
 * Four vertices per edge: root, root, tip, tip, first end before second. Fins run the way in which the fur is laid.
 *
 * @param surface the shells' geometry
 * @param mask a bit for each edge of it, lowest first; undefined: all have fins
 * @throws Error for a mask of another number of edges
 */
export function finQuads(surface: BufferGeometry, mask: Uint8Array | undefined, places: FinPlaces): BufferGeometry {
	const { start, tile, lean, tiles, roots: scale } = places;
	const faces = new EdgeFaces(surface);
	if (mask && mask.length !== Math.ceil(faces.count / 8))
		throw new Error(
			`got a mask of ${mask.length} bytes, expected ${Math.ceil(faces.count / 8)} for ${faces.count} edges`,
		);
	const edges = [...faces.edges].filter((_, i) => !mask || (mask[i >> 3] as number) & (1 << (i & 7)));
	const count = edges.length;
	const quads = new BufferGeometry();
	for (const [name, size] of Object.entries(SIZES)) {
		if (COPIED.includes(name) ? surface.hasAttribute(name) : name !== 'uv1' || scale)
			quads.setAttribute(name, new Float32BufferAttribute(count * 4 * size, size));
	}
	const roots = [new Root(surface, quads), new Root(surface, quads)] as const;
	const [along, laid, one, two] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
	for (const [i, edge] of edges.entries()) {
		const [from, to] = roots;
		from.read(edge.from);
		to.read(edge.to);
		along.subVectors(to.place, from.place);
		const length = along.length() / tile;
		laid.addVectors(from.across, to.across).normalize();
		const cosine = along.normalize().dot(laid);
		const sheared = lean * (1 - Math.abs(cosine));
		const begin = (start + GOLDEN * i) % 1;
		faces.normals(edge, one, two);
		// Direction into the face of a border, as if of a face that eyes outside see from behind: an outline to them.
		if (edge.one === edge.two) two.cross(along);
		if (cosine < 0) along.negate();
		for (const [end, root] of (cosine < 0 ? [to, from] : roots).entries()) {
			const u = begin + end * length;
			root.write(4 * i + end, along, one, two, u / tiles, 0);
			root.write(4 * i + end + 2, along, one, two, (u + sheared) / tiles, 1 / tiles);
			if (scale) for (const at of [4 * i + end, 4 * i + end + 2]) root.mark(at, scale[0] * tiles, scale[1] * tiles);
		}
	}
	quads.setIndex(
		Array.from({ length: 6 * count }, (_, i) => 4 * Math.floor(i / 6) + ([0, 1, 3, 0, 3, 2][i % 6] as number)),
	);
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
		// Combs that copies of a vertex share are vectors.
		if (_comb?.itemSize === 3) t.fromBufferAttribute(_comb, vertex);
		else t.multiplyScalar(_comb?.getX(vertex) ?? 0).addScaledVector(this.across, _comb?.getY(vertex) ?? 0);
	}

	/** Writes the place of a vertex in the picture of the roots. */
	mark(at: number, across: number, down: number): void {
		const { uv } = this.surface.attributes;
		if (uv) this.quads.attributes.uv1?.setXY(at, across * uv.getX(this.#vertex), down * uv.getY(this.#vertex));
	}

	/**
	 * Writes a vertex of a fin.
	 *
	 * @param along unit, the edge; `one`, `two`: normals of its faces
	 */
	write(at: number, along: Vector3, one: Vector3, two: Vector3, u: number, v: number): void {
		const { position, normal, tangent, uv, _fur, _edge } = this.quads.attributes;
		const { _fur: fur } = this.surface.attributes;
		const [vertex, n] = [this.#vertex, this.#normal];
		position?.setXYZ(at, ...this.place.toArray());
		normal?.setXYZ(at, ...n.toArray());
		tangent?.setXYZW(at, along.x, along.y, along.z, 1);
		uv?.setXY(at, u, v);
		const [upright, aside] = this.#spare;
		aside.crossVectors(along, n);
		// Angle about the normal from the edge to where the fur is laid.
		const laid = Math.atan2(this.across.dot(aside), this.across.dot(along)) / (2 * Math.PI);
		_fur?.setXYZW(at, laid, fur?.getY(vertex) ?? 1, fur?.getZ(vertex) ?? 1, fur?.getW(vertex) ?? 0);
		for (const name of COPIED) {
			const [own, source] = [this.quads.attributes[name], this.surface.attributes[name]];
			for (let c = 0; own && source && c < own.itemSize; c++) own.setComponent(at, c, source.getComponent(vertex, c));
		}
		// The comb, along the edge made perpendicular to the normal, and across.
		aside.normalize();
		const comb = [this.#comb.dot(upright.crossVectors(n, aside)), this.#comb.dot(aside)] as const;
		// Angles about the edge, from the normal made perpendicular to it.
		upright.copy(n).addScaledVector(along, -along.dot(n)).normalize();
		aside.crossVectors(along, upright);
		const angle = (face: Vector3) => Math.atan2(face.dot(aside), face.dot(upright)) / Math.PI;
		_edge?.setXYZW(at, angle(one), angle(two), ...comb);
	}
}
