/** Light of cut fur, derived from the baked texels alone: slabs get the light that the removed hair used to stop. */

import { alphaChannel, channelOf } from '../format.ts';

/** TexelCoding of a texture with one slab after the other, the lowest first. */
export interface Slabs {
	/** RGBA bytes, coefficients and coverage as the format has them. */
	planes: readonly Uint8Array[];
	/** How coefficients are decoded: a = scale·(byte − bias). */
	scale: readonly number[];
	bias: readonly number[];
	layers: number;
}

/** Shares of the view from straight above that go to hairs that are hardly seen, and to these and faint ones. */
const SEEN = [0.15, 0.4];

/** Numbers per row of the shaders' table: four RGBA texels. */
const ROW = 16;

/**
 * Stand-in of each remaining slab: the place in the whole fur, in slab middles, with the same share of the view from
 * straight above over it. Whole fur is as bright there as the slab in cut fur: short fur reflects as much light as long
 * fur, whatever the light's direction (`furbake trim` has the figures).
 *
 * @param share of the fur's height that is left, above 0
 */
export function standIns(slabs: Slabs, share: number): Float64Array {
	const whole = shareAbove(slabs, 1);
	return shareAbove(slabs, share).map((above) => {
		let k = whole.length - 1;
		while (k > 0 && (whole[k] as number) < above) k--;
		const [here, next] = [whole[k] as number, whole[k + 1]];
		return next === undefined ? k : k + Math.min((here - Math.min(above, here)) / (here - next || 1), 1);
	});
}

/**
 * Heights below which fur is hardly seen and is faint, shares of what is left of its height: a single shell can stand for
 * all below the first, one a slab below the second.
 *
 * @param share of the fur's height that is left, above 0
 */
export function hiddenShares(slabs: Slabs, share: number): number[] {
	const parts = seenParts(slabs, share);
	return SEEN.map((seen) => {
		let left = seen;
		const k = parts.findIndex((part) => {
			left -= part;
			return left < 0;
		});
		return k < 0 ? 0 : Math.min((k + 1 + left / (parts[k] as number)) / (slabs.layers * share), 1);
	});
}

/** Share of the view from above that lies over the middle of each remaining slab. */
function shareAbove(slabs: Slabs, share: number): Float64Array {
	const seen = seenParts(slabs, share);
	let above = 0;
	for (let k = seen.length - 1; k >= 0; k--) {
		const part = seen[k] as number;
		seen[k] = above + part / 2;
		above += part;
	}
	return seen;
}

/** Share of the view from above that each remaining slab has of all of them. */
function seenParts({ planes, scale, layers }: Slabs, share: number): Float64Array {
	const { plane, channel } = alphaChannel(scale.length);
	const bytes = planes[plane] as Uint8Array;
	const size = Math.floor(bytes.length / 4 / layers);
	const left = layers * share;
	const seen = new Float64Array(Math.ceil(left - 1e-6));
	const clear = new Float64Array(size).fill(1);
	for (let k = seen.length - 1; k >= 0; k--) {
		const thickness = Math.min(left - k, 1);
		for (let i = 0; i < size; i++) {
			const through = 1 - (bytes[4 * (k * size + i) + channel] as number) / 255;
			const rest = (clear[i] as number) * (thickness < 1 ? through ** thickness : through);
			seen[k] = (seen[k] as number) + (clear[i] as number) - rest;
			clear[i] = rest;
		}
	}
	const all = seen.reduce((sum, part) => sum + part, 0) || 1;
	return seen.map((part) => part / all);
}

/** Source of the table, computed once: α-weighted mean of each slab's coefficients, and their pull. */
export class SlabMeans {
	readonly #layers: number;
	readonly #means: Float64Array[];
	/** S⁻¹·ā with S the α-weighted mean of a·aᵀ: the vector whose product with the slab's texels is as near 1 as can be. */
	readonly #pulls: Float64Array[];

	constructor({ planes, scale, bias, layers }: Slabs) {
		this.#layers = layers;
		const count = scale.length;
		const alpha = alphaChannel(count);
		const texels = (planes[0] as Uint8Array).length / 4;
		const a = new Float64Array(count);
		const slabs = Array.from({ length: layers }, (_, k) => {
			const [sum, squares] = [new Float64Array(count), new Float64Array(count * count)];
			let total = 1e-9;
			for (let i = Math.floor((k * texels) / layers); i < Math.floor(((k + 1) * texels) / layers); i++) {
				const weight = (planes[alpha.plane] as Uint8Array)[4 * i + alpha.channel] as number;
				if (weight === 0) continue;
				total += weight;
				for (let c = 0; c < count; c++) {
					const { plane, channel } = channelOf(c);
					const byte = (planes[plane] as Uint8Array)[4 * i + channel] as number;
					a[c] = (scale[c] as number) * (byte - (bias[c] as number));
					sum[c] = (sum[c] as number) + weight * (a[c] as number);
				}
				for (let c = 0; c < count; c++)
					for (let d = 0; d < count; d++)
						squares[c * count + d] = (squares[c * count + d] as number) + weight * (a[c] as number) * (a[d] as number);
			}
			return { mean: sum.map((value) => value / total), squares: squares.map((value) => value / total) };
		});
		this.#means = slabs.map(({ mean }) => mean);
		this.#pulls = slabs.map(({ mean, squares }) => solve(squares, mean));
	}

	/**
	 * A row per slab: pull of coefficients 0..2 and 3..5, then change of the mean coefficients, three numbers and a spare one
	 * each. Moments m become m + pull·(change·m): a texel's light changes by as much as the slab's mean does, and keeps its
	 * own difference from it.
	 *
	 * @param places as from `standIns`
	 * @param table takes the result, 16 numbers a row
	 */
	fill(places: Float64Array, table: Float32Array): void {
		table.fill(0);
		for (const [k, place] of places.entries()) {
			const [low, share] = [Math.floor(place), place % 1];
			const [mean, from] = [this.#means[k] as Float64Array, this.#means[low] as Float64Array];
			const to = this.#means[Math.min(low + 1, this.#layers - 1)] as Float64Array;
			for (let c = 0; c < mean.length; c++) {
				const at = k * ROW + Math.floor(c / 3) * 4 + (c % 3);
				table[at] = this.#pulls[k]?.[c] as number;
				table[at + ROW / 2] = (from[c] as number) * (1 - share) + (to[c] as number) * share - (mean[c] as number);
			}
		}
	}
}

/** x of A·x = b for a positive semidefinite A with a trace of a millionth added, by elimination. */
function solve(matrix: Float64Array, b: Float64Array): Float64Array {
	const n = b.length;
	const a = matrix.slice();
	const x = b.slice();
	const at = (i: number, j: number) => a[i * n + j] as number;
	const ridge = 1e-6 * b.reduce((trace, _, i) => trace + at(i, i), 1e-12);
	for (let i = 0; i < n; i++) a[i * n + i] = at(i, i) + ridge;
	for (let i = 0; i < n; i++)
		for (let row = i + 1; row < n; row++) {
			const factor = at(row, i) / at(i, i);
			for (let j = i; j < n; j++) a[row * n + j] = at(row, j) - factor * at(i, j);
			x[row] = (x[row] as number) - factor * (x[i] as number);
		}
	for (let i = n - 1; i >= 0; i--) {
		for (let j = i + 1; j < n; j++) x[i] = (x[i] as number) - at(i, j) * (x[j] as number);
		x[i] = (x[i] as number) / at(i, i);
	}
	return x;
}
