/** Light that has met several hairs, and its effect on colour. Free of three. */

import type { FurAsset, Multiple } from '../format.ts';
import { curveValues, heldRadius, type MeanCurves, rings } from './curves.ts';
import { BODY_RADIUS } from './moments.ts';

/** Brightest hair colour for multiple scattering. */
const MAX_COLOUR = 0.98;

/** Factor in g = c·factor/(1 − ρc): gain of multiply scattered light for hairs of colour c. */
export const orderFactor = ({ albedo, ratio }: Multiple, slab: number): number =>
	(1 - (ratio[slab] ?? 0) * albedo) / albedo;

/** g: light that has met several hairs of this colour, over that of the samples. @param colour one channel, linear */
export function gainOf(multiple: Multiple, slab: number, colour: number): number {
	const held = Math.min(colour, MAX_COLOUR);
	return (held * orderFactor(multiple, slab)) / (1 - (multiple.ratio[slab] ?? 0) * held);
}

/**
 * x: share of a slab's light that has met several hairs.
 *
 * @param height lz
 * @param radius β of the body
 */
export function shareOf({ shares }: Multiple, slab: number, height: number, radius: number): number {
	const [even = 0, steep = 0, body = 0] = shares[slab] ?? [];
	const beta = heldRadius(radius);
	const share = even + steep * Math.sqrt(Math.max(height, 0)) + (3 * body * (beta - 1)) / (2 * beta + 1);
	return Math.min(Math.max(share, 0), 1);
}

/** `shareOf` of every slab under an even sky. @param weights a row per slab, of the mean curves */
export function skyShares(
	multiple: Multiple,
	{ curves }: MeanCurves,
	weights: readonly (readonly number[])[],
	radius: number,
): number[] {
	const sums = weights.map(() => [0, 0] as [many: number, all: number]);
	for (const { height, share } of rings(radius)) {
		// The lean's part cancels over all azimuths.
		const values = curveValues(curves, height, 0, radius);
		for (const [k, sum] of sums.entries()) {
			const mean = (weights[k] ?? []).reduce((total, weight, q) => total + weight * (values[q] ?? 0), 0);
			const light = share * Math.max(mean, 0);
			sum[0] += light * shareOf(multiple, k, height, radius);
			sum[1] += light;
		}
	}
	return sums.map(([many, all]) => (all > 0 ? many / all : 1));
}

/**
 * Conversion between the colour of hairs and the colour of their fur. Hairs take light from each other, so fur is darker
 * and more saturated than its hairs. Linear, per channel.
 */
export class FurColors {
	readonly #multiple: Multiple;
	readonly #shares: readonly number[];

	/** @param shares of light that has met several hairs, of every slab: `skyShares` */
	constructor(multiple: Multiple, shares: readonly number[]) {
		this.#multiple = multiple;
		this.#shares = shares;
	}

	/** Conversion for an asset's dry pelt; undefined where the asset lacks the numbers, and fur has the colour of its hairs. */
	static of(asset: Pick<FurAsset, 'curves' | 'pelts'>): FurColors | undefined {
		const { curves, pelts } = asset;
		const { multiple, weights = [] } = pelts[0] ?? {};
		if (!curves || !multiple) return undefined;
		return new FurColors(multiple, skyShares(multiple, { curves, way: [0, 1] }, weights, BODY_RADIUS));
	}

	/** Mean colour, from above in even light, of fur whose hairs have this colour; relative to the samples' light. */
	seen(colour: number): number {
		const { seen, tint } = this.#multiple;
		return seen.reduce((sum, part, k) => {
			const gain = gainOf(this.#multiple, k, colour * (tint[k] ?? 1));
			return sum + part * colour * (1 + (this.#shares[k] ?? 0) * (gain - 1));
		}, 0);
	}

	/** Colour of the hairs whose fur is seen in this colour; at most 1. */
	hairs(seen: number): number {
		let [low, high] = [0, 1];
		for (let i = 0; i < 40; i++) {
			const middle = (low + high) / 2;
			if (this.seen(middle) < seen) low = middle;
			else high = middle;
		}
		return (low + high) / 2;
	}
}
