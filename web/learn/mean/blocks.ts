/** Light and errors of a layer, averaged over squares of neighbouring texels. */

import type { Layer } from '../data/measurements.ts';

/** Means over the squares of a layer, row after row. */
export interface Blocks {
	/** Squares per side. */
	across: number;
	/** Coverage of each square, in bytes of all its texels. */
	cover: Float64Array;
	mean: Float64Array;
}

/**
 * Averages over squares, texels weighted by coverage.
 *
 * @param values one per texel with hair
 * @param side texels per side of a square
 */
export function blockMeans({ size, alpha, texels }: Layer, values: ArrayLike<number>, side: number): Blocks {
	const across = Math.ceil(size / side);
	const cover = new Float64Array(across * across);
	const mean = new Float64Array(across * across);
	texels.forEach((texel, i) => {
		const at = Math.floor(Math.floor(texel / size) / side) * across + Math.floor((texel % size) / side);
		const weight = alpha[texel] ?? 0;
		cover[at] = (cover[at] ?? 0) + weight;
		mean[at] = (mean[at] ?? 0) + weight * (values[i] ?? 0);
	});
	mean.forEach((sum, i) => {
		mean[i] = cover[i] ? sum / cover[i] : 0;
	});
	return { across, cover, mean };
}

/** Mean over a layer, weighted by coverage. */
export function layerMean(layer: Layer, values: ArrayLike<number>): number {
	return blockMeans(layer, values, layer.size).mean[0] ?? 0;
}

/** Errors as shares of the layer's mean light: all of them, and those that the layer does not have in common. */
export interface BlockErrors {
	all: number;
	own: number;
}

/**
 * Root mean squared error of relit squares over some lamps.
 *
 * @param relit relit light of every texel with hair under a lamp
 * @param side texels per side of a square
 * @param bright light that errors are shares of; the layer's mean under these lamps by default
 */
export function blockErrors(
	layer: Layer,
	lamps: readonly number[],
	relit: (lamp: number) => ArrayLike<number>,
	side: number,
	bright?: number,
): BlockErrors {
	const count = layer.texels.length;
	let [all, own, light, total] = [0, 0, 0, 0];
	for (const lamp of lamps) {
		const measured = layer.light.subarray(lamp * count, (lamp + 1) * count);
		const made = relit(lamp);
		const { mean: wrong, cover } = blockMeans(
			layer,
			measured.map((value, i) => (made[i] ?? 0) - value),
			side,
		);
		const weight = cover.reduce((sum, value) => sum + value, 0);
		const shared = wrong.reduce((sum, value, i) => sum + value * (cover[i] ?? 0), 0) / weight;
		wrong.forEach((value, i) => {
			all += (cover[i] ?? 0) * value ** 2;
			own += (cover[i] ?? 0) * (value - shared) ** 2;
		});
		light += weight * layerMean(layer, measured);
		total += weight;
	}
	const unit = bright ?? light / total;
	return { all: Math.sqrt(all / total) / unit, own: Math.sqrt(own / total) / unit };
}
