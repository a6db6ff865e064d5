/** The points of a skin that hairs are moved by: welded vertices, and which of them are neighbours. */

import { BufferAttribute, type BufferGeometry, type InterleavedBufferAttribute, Vector3 } from 'three';
import { sharedComb } from './comb.ts';
import { weld } from './weld.ts';

/** Of textures that hold a texel per follicle: follicle i has the texel (i % 256, ⌊i / 256⌋). */
export const FOLLICLES_PER_ROW = 256;

type Attribute = BufferAttribute | InterleavedBufferAttribute;

/** One for each surface. Furs of one body have their positions in common, whatever geometry these are in. */
const known = new WeakMap<Attribute, Follicles>();

/**
 * A surface's vertices without their copies in overlapping patches. Lengths and axes are the shells' own mesh's; the node
 * that the shells are takes them to the model's.
 */
export class Follicles {
	/** How many there are. */
	readonly count: number;
	/** Three numbers each. */
	readonly position: Float32Array;
	/** Unit vectors. */
	readonly normal: Float32Array;
	/** Displacement of the tip in the tangent plane, share of the hair's length, three numbers each: as it was combed. */
	readonly comb: Float32Array;
	/** Share of the longest fur, 0..1. */
	readonly length: Float32Array;
	/** Where each one's neighbours begin in `links`; one more than there are follicles. */
	readonly first: Uint32Array;
	/** Neighbours along the surface's edges, each edge from both its ends. */
	readonly links: Uint32Array;
	/** The attribute `follicle` by the positions of what has it. */
	readonly #marks = new WeakMap<Attribute, BufferAttribute>();

	/** Those of a surface: of the shells, whose copies of a vertex share what they are combed by. */
	static of(surface: BufferGeometry): Follicles {
		const position = surface.getAttribute('position');
		const follicles = known.get(position) ?? new Follicles(surface);
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
		this.position = new Float32Array(3 * count);
		this.normal = new Float32Array(3 * count);
		this.comb = new Float32Array(3 * count);
		this.length = new Float32Array(count).fill(1);
		const vector = new Vector3();
		for (const [i, at] of point.entries()) {
			vector.fromBufferAttribute(position, i).toArray(this.position, 3 * at);
			vector
				.fromBufferAttribute(normal, i)
				.normalize()
				.toArray(this.normal, 3 * at);
			if (comb) vector.fromBufferAttribute(comb, i).toArray(this.comb, 3 * at);
			if (fur) this.length[at] = fur.getY(i);
		}
		[this.first, this.links] = neighbours(surface, point, count);
		this.#marks.set(position, new BufferAttribute(Float32Array.from(point), 1));
	}

	/**
	 * Gives a geometry the attribute `follicle`, which of them each vertex has, if it has not got it.
	 *
	 * @param geometry the surface, or one in its axes: there it is the follicle at the vertex's place, else the nearest one;
	 * of several the one whose normal is most alike
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
		// By their place along x, from which the search goes both ways.
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

/** How many at the beginning of an order are `before` something. */
function lowerBound(order: Uint32Array, before: (at: number) => boolean): number {
	let [low, high] = [0, order.length];
	while (low < high) {
		const middle = (low + high) >> 1;
		if (before(order[middle] as number)) low = middle + 1;
		else high = middle;
	}
	return low;
}

/** @param point of each vertex the follicle @returns where each one's neighbours begin, and the neighbours */
function neighbours(surface: BufferGeometry, point: Uint32Array, count: number): [Uint32Array, Uint32Array] {
	const { index } = surface;
	const corners = index?.count ?? point.length;
	const follicle = (corner: number) => point[index?.getX(corner) ?? corner] as number;
	// Both ends of an edge in one number: sorted, equal ones stand together.
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
