/** Follicles: welded vertices of a skin and their neighbours, by which hairs move. */

import { BufferAttribute, type BufferGeometry, type InterleavedBufferAttribute, Vector3 } from 'three';
import { sharedComb } from './comb.ts';
import { weld } from './weld.ts';

/** Width of textures with a texel per follicle: follicle i has the texel (i % 256, ⌊i / 256⌋). */
export const FOLLICLES_PER_ROW = 256;

type Attribute = BufferAttribute | InterleavedBufferAttribute;

/** Follicles by the position attribute, which furs of one body share. */
const known = new WeakMap<Attribute, FurFollicles>();

/**
 * A surface's vertices without their copies in overlapping patches. Units and axes are those of the shells' mesh; the shells' node
 * transforms them to the model's.
 */
export class FurFollicles {
	/** How many there are. */
	readonly count: number;
	/** Texels across a texture with a texel per follicle: follicle i has the texel (i % columns, ⌊i / columns⌋). */
	readonly columns = FOLLICLES_PER_ROW;
	/** Texels along it. */
	readonly rows: number;
	/** A vertex of the surface for each. */
	readonly vertex: Uint32Array;
	/** Three numbers each. */
	readonly position: Float32Array;
	/** Unit vectors. */
	readonly normal: Float32Array;
	/** Combed displacement of the tip in the tangent plane, share of the hair's length, three numbers each. */
	readonly comb: Float32Array;
	/** Share of the longest fur, 0..1. */
	readonly length: Float32Array;
	/** Start of each follicle's neighbours in `links`, and the end of the last. */
	readonly first: Uint32Array;
	/** Neighbours along the surface's edges, each edge from both its ends. */
	readonly links: Uint32Array;
	/** Four bones that carry each, numbers in the skeleton; undefined: a body without a skeleton. */
	readonly bones: Uint16Array | undefined;
	/** Weight of each of the four. */
	readonly boneWeights: Float32Array | undefined;
	/** Attributes `follicle` by the position attribute of their geometry. */
	readonly #marks = new WeakMap<Attribute, BufferAttribute>();

	/** Follicles of a surface: the shells', whose copies of a vertex share one comb. */
	static of(surface: BufferGeometry): FurFollicles {
		const position = surface.getAttribute('position');
		const follicles = known.get(position) ?? new FurFollicles(surface);
		known.set(position, follicles);
		return follicles;
	}

	private constructor(surface: BufferGeometry) {
		const [position, normal, fur] = ['position', 'normal', '_fur'].map((name) => surface.getAttribute(name)) as [
			Attribute,
			Attribute,
			Attribute | undefined,
		];
		const own = surface.getAttribute('_comb');
		const comb = own?.itemSize === 2 ? sharedComb(surface) : own;
		const { count, point } = weld(surface);
		this.count = count;
		this.rows = Math.ceil(count / FOLLICLES_PER_ROW);
		this.vertex = new Uint32Array(count);
		this.position = new Float32Array(3 * count);
		this.normal = new Float32Array(3 * count);
		this.comb = new Float32Array(3 * count);
		this.length = new Float32Array(count).fill(1);
		const vector = new Vector3();
		for (const [i, at] of point.entries()) {
			this.vertex[at] = i;
			vector.fromBufferAttribute(position, i).toArray(this.position, 3 * at);
			vector
				.fromBufferAttribute(normal, i)
				.normalize()
				.toArray(this.normal, 3 * at);
			if (comb) vector.fromBufferAttribute(comb, i).toArray(this.comb, 3 * at);
			if (fur) this.length[at] = fur.getY(i);
		}
		[this.bones, this.boneWeights] = bonesOf(surface, point, count);
		[this.first, this.links] = neighbours(surface, point, count);
		this.#marks.set(position, new BufferAttribute(Float32Array.from(point), 1));
	}

	/**
	 * Adds the attribute `follicle`, the follicle of each vertex, to a geometry that lacks it.
	 *
	 * @param geometry the surface, or one in its axes, which takes the follicle at the vertex's place, else the nearest one; of
	 * several, the one with the most similar normal
	 */
	mark(geometry: BufferGeometry): void {
		if (geometry.hasAttribute('follicle')) return;
		const position = geometry.getAttribute('position');
		const mark = this.#marks.get(position) ?? new BufferAttribute(this.#nearest(geometry), 1);
		this.#marks.set(position, mark);
		geometry.setAttribute('follicle', mark);
	}

	#nearest(geometry: BufferGeometry): Float32Array {
		const [position, normal] = [geometry.getAttribute('position'), geometry.getAttribute('normal')];
		// Sorted along x; the search goes both ways from there.
		const x = (at: number) => this.position[3 * at] as number;
		const order = Uint32Array.from({ length: this.count }, (_, i) => i).sort((a, b) => x(a) - x(b));
		const [p, n] = [new Vector3(), new Vector3()];
		return Float32Array.from({ length: position.count }, (_, i) => {
			p.fromBufferAttribute(position, i);
			n.fromBufferAttribute(normal, i);
			let [best, closest, likest] = [0, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
			const start = lowerBound(order, (at) => x(at) < p.x);
			for (const [from, step] of [
				[start, 1],
				[start - 1, -1],
			] as const) {
				for (let o = from; o >= 0 && o < order.length; o += step) {
					const at = order[o] as number;
					if ((x(at) - p.x) ** 2 > closest) break;
					const away = this.#away(at, p);
					if (away > closest) continue;
					const alike = this.#along(at, n);
					if (away < closest || alike > likest) [best, closest, likest] = [at, away, alike];
				}
			}
			return best;
		});
	}

	/** Squared distance. */
	#away(at: number, { x, y, z }: Vector3): number {
		const { position } = this;
		const [px, py, pz] = [position[3 * at], position[3 * at + 1], position[3 * at + 2]] as [number, number, number];
		return (px - x) ** 2 + (py - y) ** 2 + (pz - z) ** 2;
	}

	#along(at: number, { x, y, z }: Vector3): number {
		const { normal } = this;
		const [nx, ny, nz] = [normal[3 * at], normal[3 * at + 1], normal[3 * at + 2]] as [number, number, number];
		return nx * x + ny * y + nz * z;
	}
}

/** Number of leading entries for which `before` holds. */
function lowerBound(order: Uint32Array, before: (at: number) => boolean): number {
	let [low, high] = [0, order.length];
	while (low < high) {
		const middle = (low + high) >> 1;
		if (before(order[middle] as number)) low = middle + 1;
		else high = middle;
	}
	return low;
}

/** @param point follicle of each vertex, all of whose vertices hang on the same bones @returns bones and weights */
function bonesOf(surface: BufferGeometry, point: Uint32Array, count: number): [Uint16Array?, Float32Array?] {
	const [index, weight] = [surface.getAttribute('skinIndex'), surface.getAttribute('skinWeight')];
	if (!index || !weight) return [];
	const [numbers, weights] = [new Uint16Array(4 * count), new Float32Array(4 * count)];
	for (const [i, at] of point.entries()) {
		for (let c = 0; c < 4; c++) {
			numbers[4 * at + c] = index.getComponent(i, c);
			weights[4 * at + c] = weight.getComponent(i, c);
		}
	}
	return [numbers, weights];
}

/** @param point follicle of each vertex @returns start of each one's neighbours, and the neighbours */
function neighbours(surface: BufferGeometry, point: Uint32Array, count: number): [Uint32Array, Uint32Array] {
	const { index } = surface;
	const corners = index?.count ?? point.length;
	const follicle = (corner: number) => point[index?.getX(corner) ?? corner] as number;
	// Both ends of an edge in one number, so that sorting puts equal edges together.
	const edges = new Float64Array(2 * corners);
	for (let i = 0; i < corners; i++) {
		const [a, b] = [follicle(i), follicle(i % 3 === 2 ? i - 2 : i + 1)];
		edges[2 * i] = a * count + b;
		edges[2 * i + 1] = b * count + a;
	}
	edges.sort();
	const distinct = edges.filter((edge, i) => edge !== edges[i - 1] && edge % (count + 1) !== 0);
	const first = new Uint32Array(count + 1);
	for (const edge of distinct) (first[Math.floor(edge / count) + 1] as number)++;
	for (let i = 0; i < count; i++) first[i + 1] = (first[i + 1] as number) + (first[i] as number);
	return [first, Uint32Array.from(distinct, (edge) => edge % count)];
}
