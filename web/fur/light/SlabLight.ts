import { ClampToEdgeWrapping, DataTexture, DataUtils, FloatType, HalfFloatType, LinearFilter, RGBAFormat } from 'three';
import { type Basis, type Curves, KNOTS, type Multiple, RADII } from '../format.ts';
import { type CurveSky, curveSkies, type MeanCurves, type RingParts } from './curves.ts';
import { orderFactor, skyShares } from './multiple.ts';

/** TexelCoding per row: see shaders/light/curves.glsl. */
const ROW = 64;

/** Columns of the sky's light: first harmonic, stride from one β to the next, first polynomial. */
const [HARMONICS, RADIUS, POLYNOMIALS] = [1, 14, 43] as const;

/** Columns of light that has met several hairs: its share; ρ and related numbers; the hairs' mean colour. */
const [SHARES, ORDERS, HAIRS] = [61, 62, 63] as const;

/** A row per slab, one weight per curve. */
export type Weights = readonly (readonly number[])[];

/** Data of one state's slabs. */
export interface SlabState {
	/** Weights of the mean curves. */
	weights: Weights;
	/** Colour of light that has met several hairs. */
	multiple?: Multiple | undefined;
}

/** Lookup table of mean curves, fur after fur: rows are `even` at three radii, then `along`; columns are knots; RGBA are up to four curves. */
export function curveTable(furs: readonly Curves[]): DataTexture {
	const rows = furs.length * 2;
	const data = new Uint16Array(4 * KNOTS * rows * RADII.length);
	for (const [part, tables] of furs.flatMap(({ even, along }) => [even, along]).entries())
		for (const [q, table] of tables.entries())
			for (const [b, knots] of table.entries())
				for (const [i, value] of knots.entries())
					data[4 * (KNOTS * (RADII.length * part + b) + i) + q] = DataUtils.toHalfFloat(value);
	const texture = new DataTexture(data, KNOTS, rows * RADII.length, RGBAFormat, HalfFloatType);
	texture.magFilter = texture.minFilter = LinearFilter;
	texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
	texture.needsUpdate = true;
	return texture;
}

/** Lookup table per slab: weights of the mean curves, and the sky's light that follows from them. */
export class SlabLight {
	/** A row per slab, state after state, in each fur after fur. */
	texture: DataTexture;
	readonly #means: readonly MeanCurves[];
	/** Of each fur, for each of `RADII`, an entry per curve. */
	readonly #skies: readonly CurveSky[][][];
	#states: readonly SlabState[];

	/**
	 * @param means of each fur
	 * @param states of all furs, then the next state of all furs
	 * @param fin whether the frame is a fin's
	 */
	constructor(basis: Basis, means: readonly MeanCurves[], states: readonly SlabState[], fin: boolean) {
		this.#means = means;
		this.#skies = means.map((own) => {
			const known = new Map<number, RingParts>();
			return RADII.map((radius) => curveSkies(basis, own, radius, fin, known));
		});
		this.#states = states;
		this.texture = tableOf(states);
		this.#fill();
	}

	/** States in the pelt's textures, the driest first. */
	set states(states: readonly SlabState[]) {
		const rows = rowsOf(states);
		this.#states = states;
		if (rows !== this.texture.image.height) {
			this.texture.dispose();
			this.texture = tableOf(states);
		}
		this.#fill();
	}

	#fill(): void {
		const data = this.texture.image.data as Float32Array;
		data.fill(0);
		let slab = 0;
		for (const [i, { weights, multiple }] of this.#states.entries()) {
			const fur = i % this.#means.length;
			const means = this.#means[fur] as MeanCurves;
			const shares = multiple && RADII.map((radius) => skyShares(multiple, means, weights, radius));
			for (const [k, own] of weights.entries()) {
				const row = data.subarray(4 * ROW * slab, 4 * ROW * ++slab);
				row.set(own);
				for (const [q, weight] of own.entries()) this.#add(row, weight, q, this.#skies[fur] as CurveSky[][]);
				if (!multiple) continue;
				for (const [b, share] of shares?.entries() ?? []) row[4 * (HARMONICS + 12 + RADIUS * b) + 3] = share[k] ?? 0;
				row.set(multiple.shares[k] ?? [], 4 * SHARES);
				const orders = [multiple.ratio[k], orderFactor(multiple, k), multiple.tint[k]];
				row.set(orders as number[], 4 * ORDERS);
				row.set(multiple.colour?.[k] ?? [], 4 * HAIRS);
			}
		}
		this.texture.needsUpdate = true;
	}

	/** @param q which curve @param radii of its fur */
	#add(row: Float32Array, weight: number, q: number, radii: readonly CurveSky[][]): void {
		const add = (texel: number, channel: number, value = 0) => {
			const at = 4 * texel + channel;
			row[at] = (row[at] as number) + weight * value;
		};
		for (const [b, skies] of radii.entries()) {
			const first = HARMONICS + RADIUS * b;
			for (const [c, own] of skies[q]?.environment.entries() ?? []) {
				for (let j = 0; j < 4; j++) {
					add(first + c, j, own[j]);
					add(first + 6 + c, j, own[4 + j]);
				}
				add(first + 12 + Math.floor(c / 3), c % 3, own[8]);
			}
		}
		// One radius is enough: polynomials differ little from body to body.
		for (const [c, own] of radii[1]?.[q]?.polynomials.entries() ?? []) {
			const first = POLYNOMIALS + 9 * Math.floor(c / 3);
			for (let j = 0; j < 9; j++) add(first + 3 * Math.floor(j / 3) + (c % 3), j % 3, own[j]);
		}
	}
}

function tableOf(states: readonly SlabState[]): DataTexture {
	const rows = rowsOf(states);
	return new DataTexture(new Float32Array(4 * ROW * rows), ROW, rows, RGBAFormat, FloatType);
}

function rowsOf(states: readonly SlabState[]): number {
	return states.reduce((sum, { weights }) => sum + weights.length, 0);
}

/** State of cut fur: light of the stand-ins, hairs of the slabs themselves. */
export function standInState({ weights, multiple }: SlabState, places: ArrayLike<number>): SlabState {
	return {
		weights: standInWeights(weights, places),
		multiple: multiple && {
			...multiple,
			shares: standInWeights(multiple.shares, places) as number[][],
			ratio: standInWeights(
				multiple.ratio.map((ratio) => [ratio]),
				places,
			).flat(),
		},
	};
}

/** Weights of the stand-ins, interpolated linearly. @param places as from `standIns` */
export function standInWeights(weights: Weights, places: ArrayLike<number>): Weights {
	return weights.map((_, k) => {
		const place = places[Math.min(k, places.length - 1)] ?? k;
		const [from, share] = [Math.floor(place), place % 1];
		const next = weights[Math.min(from + 1, weights.length - 1)];
		return (weights[from] ?? []).map((weight, q) => weight + share * ((next?.[q] ?? 0) - weight));
	});
}
