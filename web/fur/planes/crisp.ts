/**
 * Crisp hairs: where coverage is blended between texels as large as pixels, hairs are broad and half transparent. More
 * contrast around a level of each slab, lower for thicker shells, makes them narrow and opaque, and fur hides as much.
 */

import type { CompressedArrayTexture } from 'three';
import { alphaChannel } from '../format.ts';
import type { FurTextures } from '../light/texels.ts';

/** Contrast of coverage in a picture, and the coverage below which nothing is drawn. */
export interface Contrast {
	contrast: number;
	cut: number;
}

/** Slabs that a ray to the eye crosses in a shell, at both of which fur hides as much: of many shells, and seen aslant. */
const [THIN, THICK] = [0.25, 2] as const;

/** Steps by halves towards the level: finer than a byte. */
const STEPS = 10;

/** Values told apart. */
const BINS = 256;

/** Largest factor by which the level falls from thin shells to thick ones. */
const FALL = 4;

/**
 * Share of the level that is kept. Thin places have most of the light that comes from aside, and vanish: fur has to hide a
 * little more for as much light on the mean of all sides.
 */
const LOWER = 0.94;

/** Range of the stored numbers. */
const RANGE = 4;

interface Level {
	data: Uint8Array;
	width: number;
	height: number;
}

interface Slab {
	/** Coverage and others, rgba. */
	texels: Uint8Array;
	width: number;
	height: number;
	channel: number;
}

/**
 * Levels of coverage that keep their value where the picture's contrast is raised, for `keptLevel` of hair/shell.glsl: of
 * a shell through which a ray crosses e slabs, c₀/(1 + r·e).
 *
 * @param textures the slabs of a state after those of the one before; where the processor has no bytes of them all levels
 * are one half
 * @param contrasts with which texels of the finest level and of the next one hide as much as without; with others they
 * nearly do
 * @returns four numbers for two slabs each: c₀ and r of the finest level, of the next one, and of the next slab's; each two
 * as 16 bits, of a range from 0 to 4
 */
export function crispLevels({ plane0, plane1 }: FurTextures, contrasts: readonly [Contrast, Contrast]): Uint32Array {
	const { plane, channel } = alphaChannel(plane1 ? 6 : 3);
	const { mipmaps, image } = (plane === 1 ? plane1 : plane0) as CompressedArrayTexture;
	const layers = (image as { depth: number } | null)?.depth ?? 0;
	const levels = new Uint32Array(4 * Math.ceil(layers / 2));
	for (let i = 0; i < 2 * layers; i++) {
		const found = (mipmaps?.[i % 2] ?? mipmaps?.[0]) as Level | undefined;
		let [thin, fall] = [0.5, 0];
		if (found?.data) {
			const { data, width, height } = found;
			const size = data.length / layers;
			const texels = data.subarray((i >> 1) * size, ((i >> 1) + 1) * size);
			const shares = between({ texels, width, height, channel });
			const contrast = contrasts[i % 2] as Contrast;
			const one = keptLevel(shares, THIN, contrast);
			const two = Math.max(keptLevel(shares, THICK, contrast), one / FALL);
			fall = Math.max(one - two, 0) / (THICK * two - THIN * one);
			thin = LOWER * one * (1 + THIN * fall);
		}
		levels[i] = stored(thin) + 65536 * stored(fall);
	}
	return levels;
}

/** Value of 0 to `RANGE` as 16 bits, as `unpackUnorm2x16` reads them. */
function stored(value: number): number {
	return Math.round((value / RANGE) * 65535);
}

/** Shares of the values that coverage has between texels, a quarter of a texel off their middles. */
function between({ texels, width, height, channel }: Slab): Float64Array {
	const shares = new Float64Array(BINS);
	const at = (column: number, row: number) => texels[4 * (row * width + column) + channel] as number;
	for (let row = 0; row < height; row++) {
		const below = (row + 1) % height;
		for (let column = 0; column < width; column++) {
			const right = (column + 1) % width;
			const value = (9 * at(column, row) + 3 * (at(right, row) + at(column, below)) + at(right, below)) / 16;
			shares[Math.round(value)] = (shares[Math.round(value)] as number) + 1 / (width * height);
		}
	}
	return shares;
}

/**
 * Level c at which clamp((a − c)·contrast + c, 0, 1), without what is cut, hides as much as a.
 *
 * @param shares of a's values
 */
function keptLevel(shares: Float64Array, slabs: number, { contrast, cut }: Contrast): number {
	const hides = Float64Array.from(shares, (_, byte) => 1 - Math.max(1 - byte / (BINS - 1), 0.004) ** slabs);
	const hidden = (change: (a: number) => number) =>
		shares.reduce((sum, share, byte) => {
			const a = Math.min(change(byte / (BINS - 1)), 1);
			return a < cut ? sum : sum + share * (hides[Math.round(a * (BINS - 1))] as number);
		}, 0);
	const wanted = shares.reduce((sum, share, byte) => sum + share * (hides[byte] as number), 0);
	let [low, high] = [0, 1];
	for (let step = 0; step < STEPS; step++) {
		const level = (low + high) / 2;
		if (hidden((a) => (a - level) * contrast + level) > wanted) low = level;
		else high = level;
	}
	return high;
}
