/** Law of light and eye of `pelt/eye.py`: factor of light for an eye beside the fur, by a bake's own numbers. */

import type { FurAsset } from '../../fur/index.ts';

/** Unit vector: along the fur's lean, across it to the left, up. */
export type Way = readonly [number, number, number];

/** Smallest factor. */
const MIN_FACTOR = 0.1;

/**
 * [q, a, q·b, p·b, q·z, q·b², p, a², p·a·b, q·p, q·b·z, q·a·b, a·z, p·z, q·z², q·p·b] of a light and an eye; neither is below
 * the horizon.
 */
export function termsOf(light: Way, eye: Way): number[] {
	const a = light[0] * eye[0] + light[1] * eye[1];
	const [b, p, z, q] = [light[0], eye[0], light[2], 1 - eye[2] ** 2];
	const first = [q, a, q * b, p * b, q * z, q * b * b, p, a * a, p * a * b, q * p, q * b * z, q * a * b];
	return [...first, a * z, p * z, q * z * z, q * p * b];
}

/**
 * G: light seen by an eye at height `s` in the fur, over that seen from straight above.
 *
 * @param numbers rows for 1, s and s², in each the weights of the terms
 */
export function factorOf(numbers: readonly (readonly number[])[], light: Way, eye: Way, s: number): number {
	const terms = termsOf(light, eye);
	const sums = numbers.map((row) => row.reduce((sum, weight, f) => sum + weight * (terms[f] ?? 0), 0));
	return Math.max(
		sums.reduce((sum, each, power) => sum + each * s ** power, 1),
		MIN_FACTOR,
	);
}

/**
 * Surge of a lamp beside the eye, which sees no shadows, over a lamp aside.
 *
 * @param numbers excess seen from above, further excess from aside, width in radians
 */
export function surgeOf([above, aside, width]: readonly [number, number, number], light: Way, eye: Way): number {
	const apart = light.reduce((sum, part, i) => sum + (part - (eye[i] ?? 0)) ** 2, 0);
	return 1 + (above + aside * (1 - eye[2] ** 2)) / (1 + apart / width ** 2);
}

/** Mean coverage of each slab, the lowest first. @param bytes of a plane; @param channel which of its four is α */
export function coverages(
	{ layers, size }: Pick<FurAsset, 'layers' | 'size'>,
	bytes: Uint8Array,
	channel: number,
): number[] {
	const texels = size * size;
	return Array.from({ length: layers }, (_, k) => {
		let sum = 0;
		for (let t = 0; t < texels; t++) sum += bytes[4 * (k * texels + t) + channel] ?? 0;
		return sum / 255 / texels;
	});
}

/**
 * Share of each slab in the view of the fur, for evenly spread hairs; shares sum to 1.
 *
 * @param covers of `coverages`; @param up the eye's height over the skin, as a sine
 */
export function sharesSeen(covers: readonly number[], up: number): number[] {
	const shares = covers.map(() => 0);
	let open = 1;
	for (let k = covers.length - 1; k >= 0; k--) {
		// The path through a slab is longer from aside.
		const left = (1 - (covers[k] ?? 0)) ** (1 / Math.max(up, 0.05));
		shares[k] = open * (1 - left);
		open *= left;
	}
	return shares.map((share) => share / Math.max(1 - open, 1e-9));
}

/** G of a lamp over the whole view of the fur, surge included. @param covers of `coverages` */
export function factorSeen(
	{ eye: numbers = [], surge = [0, 0, 1] }: Pick<FurAsset, 'eye' | 'surge'>,
	covers: readonly number[],
	light: Way,
	eye: Way,
): number {
	const shares = sharesSeen(covers, eye[2]);
	const factors = shares.map((share, k) => share * factorOf(numbers, light, eye, (k + 0.5) / covers.length));
	return factors.reduce((sum, each) => sum + each, 0) * surgeOf(surge, light, eye);
}
