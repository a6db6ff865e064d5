/** Surface of bodies far away: each face once, and fewer of them. */

import { Box3, BufferAttribute, BufferGeometry, Vector3 } from 'three';
import { weld } from '../body/weld.ts';

/** The part of `MeshoptSimplifier` (npm package meshoptimizer) that herds use. */
export interface FurSimplifier {
	/** Indices of a mesh with fewer faces between the same vertices, and its error. */
	simplifyWithAttributes(
		indices: Uint32Array,
		positions: Float32Array,
		positionStride: number,
		attributes: Float32Array,
		attributeStride: number,
		weights: number[],
		locked: null,
		targetCount: number,
		targetError: number,
		flags: ('Sparse' | 'ErrorAbsolute')[],
	): [indices: Uint32Array, error: number];
}

/** How many more hairs stand where several patches met: those of one leave more holes. */
const DENSER = 0.5;

/** Changes of other numbers that count as much as the greatest move of a place. */
const CHANGES = { normal: 1, color: 0.3, _fur: 0.1, _comb: 0.5, _region: 0.1 };

/**
 * The surface of a fur's shells without what its patches overlap: a face is that of the patch which covers it most, of
 * several furs of each. Patches then meet without a dissolve, which is not seen on hairs of a few pixels.
 */
export class FarSurface {
	readonly #surface: BufferGeometry;
	/** Indices of the faces that are kept. */
	readonly #faces: Uint32Array;
	/** `_fur` with the cover by all patches together. */
	readonly #fur: BufferAttribute;
	readonly #places: Float32Array;
	/** Longest side of the box around it; weights of meshoptimizer are relative to it. */
	readonly #extent: number;

	/** @param surface geometry of shells */
	constructor(surface: BufferGeometry) {
		this.#surface = surface;
		const point = pointsOf(surface);
		this.#faces = heaviest(surface, point);
		this.#fur = together(surface, point);
		this.#places = numbersOf([surface.getAttribute('position')]);
		const box = new Box3().setFromArray(this.#places);
		this.#extent = Math.max(...box.getSize(new Vector3()).toArray());
	}

	/**
	 * A geometry with the vertices of the shells.
	 *
	 * @param simplifier that leaves out faces
	 * @param error by which the surface may move, its own units
	 */
	geometry(simplifier?: FurSimplifier, error = 0): BufferGeometry {
		const far = new BufferGeometry();
		for (const [name, attribute] of Object.entries(this.#surface.attributes)) far.setAttribute(name, attribute);
		far.setAttribute('_fur', this.#fur);
		const faces = simplifier ? this.#simplified(simplifier, error) : this.#faces;
		far.setIndex(new BufferAttribute(this.#fur.count > 0xffff ? faces : Uint16Array.from(faces), 1));
		return far;
	}

	#simplified(simplifier: FurSimplifier, error: number): Uint32Array {
		const { attributes } = this.#surface;
		const kept = Object.entries(CHANGES).flatMap(([name, change]) => {
			const attribute = name === '_fur' ? this.#fur : attributes[name];
			return attribute ? [{ attribute, weight: error / (this.#extent * change) }] : [];
		});
		const weights = kept.flatMap(({ attribute, weight }) => Array<number>(attribute.itemSize).fill(weight));
		const others = numbersOf(kept.map(({ attribute }) => attribute));
		const [indices] = simplifier.simplifyWithAttributes(
			this.#faces,
			this.#places,
			3,
			others,
			weights.length,
			weights,
			null,
			0,
			error,
			['Sparse', 'ErrorAbsolute'],
		);
		return indices;
	}
}

type Numbers = Pick<BufferAttribute, 'count' | 'itemSize' | 'getComponent'>;

/** Numbers of attributes, vertex by vertex. */
function numbersOf(attributes: readonly Numbers[]): Float32Array {
	const { count = 0 } = attributes[0] ?? {};
	const size = attributes.reduce((sum, { itemSize }) => sum + itemSize, 0);
	const numbers = new Float32Array(count * size);
	let at = 0;
	for (let i = 0; i < count; i++)
		for (const attribute of attributes)
			for (let c = 0; c < attribute.itemSize; c++) numbers[at++] = attribute.getComponent(i, c);
	return numbers;
}

/** Point of the body at each vertex; points of several furs are apart. */
function pointsOf(surface: BufferGeometry): Uint32Array {
	const { count, point } = weld(surface);
	const { _region: region } = surface.attributes;
	return region ? point.map((at, i) => at + count * Math.round(255 * region.getZ(i))) : point;
}

/** Indices of each face once, of the copy with the largest weight. */
function heaviest({ index, attributes }: BufferGeometry, point: Uint32Array): Uint32Array {
	const fur = attributes._fur as BufferAttribute;
	const found = new Map<string, { corners: number[]; weight: number }>();
	for (let first = 0; first < (index?.count ?? fur.count); first += 3) {
		const corners = [0, 1, 2].map((c) => index?.getX(first + c) ?? first + c);
		const key = corners
			.map((vertex) => point[vertex] as number)
			.sort((a, b) => a - b)
			.join();
		const weight = corners.reduce((sum, vertex) => sum + fur.getX(vertex), 0);
		const known = found.get(key);
		if (!known || weight > known.weight) found.set(key, { corners, weight });
	}
	return Uint32Array.from([...found.values()].flatMap(({ corners }) => corners));
}

/** `_fur` of a surface whose weight is that of all copies of a point, and a little more where there are several. */
function together({ attributes }: BufferGeometry, point: Uint32Array): BufferAttribute {
	const fur = new BufferAttribute(numbersOf([attributes._fur as BufferAttribute]), 4);
	const sums = new Map<number, [weights: number, squares: number]>();
	for (const [i, at] of point.entries()) {
		const [weight, [weights, squares]] = [fur.getX(i), sums.get(at) ?? [0, 0]];
		sums.set(at, [weights + weight, squares + weight * weight]);
	}
	for (const [i, at] of point.entries()) {
		const [weights, squares] = sums.get(at) ?? [0, 0];
		fur.setX(i, Math.min(weights, 1) + (weights && DENSER * (1 - squares / weights ** 2)));
	}
	return fur;
}
