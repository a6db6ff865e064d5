/**
 * Crisp hairs: a texel's coverage is a mean over its square and its slab, and shells that blend it as it is show hairs
 * broad and half transparent, where real ones cover what they cross. Coverage of a slab is kept, its contrast raised.
 */

import type { PlaneBytes } from './planes.ts';

/** Contrast of the coverage over the stored one. More gains little: it ends in hair and no hair. */
const GAIN = 3;

/** Steps by halves towards the level in the middle: finer than a byte. */
const STEPS = 16;

/** Coverage byte with more contrast. @param middle byte that becomes half of full coverage */
function raised(byte: number, middle: number): number {
	return Math.min(Math.max(Math.round((byte - middle) * GAIN + 127.5), 0), 255);
}

/**
 * A plane with the contrast of its coverage raised slab by slab; a slab's mean coverage stays, empty texels stay empty.
 *
 * @param channel of the coverage, 0 to 3
 */
export function crisp(plane: PlaneBytes, layers: number, channel: number): PlaneBytes {
	const bytes = plane.slice();
	const size = bytes.length / layers;
	for (let first = 0; first < bytes.length; first += size) {
		const table = tableOf(bytes.subarray(first, first + size), channel);
		for (let at = first + channel; at < first + size; at += 4) bytes[at] = table[bytes[at] as number] as number;
	}
	return bytes;
}

/** New value of every byte of a slab's coverage. */
function tableOf(slab: Uint8Array, channel: number): Uint8Array {
	const counts = new Uint32Array(256);
	for (let at = channel; at < slab.length; at += 4) {
		const byte = slab[at] as number;
		counts[byte] = (counts[byte] as number) + 1;
	}
	const sum = (change: (byte: number) => number) =>
		counts.reduce((total, count, byte) => total + (count && count * change(byte)), 0);
	const wanted = sum((byte) => byte);
	// At the lower end no byte falls and 0 stays, at the upper one no byte rises.
	let [low, high] = [127.5 / GAIN, 255 - 127.5 / GAIN];
	for (let step = 0; step < STEPS; step++) {
		const middle = (low + high) / 2;
		if (sum((byte) => raised(byte, middle)) > wanted) low = middle;
		else high = middle;
	}
	return Uint8Array.from(counts, (_, byte) => raised(byte, (low + high) / 2));
}
