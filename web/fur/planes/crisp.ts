/**
 * Crisp hairs: where coverage is blended between texels as large as pixels, hairs are broad and half transparent. More
 * contrast around one level of each slab makes them narrow and opaque, and fur hides as much.
 */

import { type CompressedArrayTexture, Vector4 } from 'three';
import { alphaChannel } from '../format.ts';
import type { FurTextures } from '../light/texels.ts';

/** Contrast at which fur hides as much as without; at others it nearly does. */
const COVERAGE_CONTRAST = 3;

/**
 * Slabs that a ray to the eye crosses in a shell, where texels are larger than pixels and where they are smaller: magnified
 * fur has more shells.
 */
const SLABS = [0.5, 1.4] as const;

/** Largest coverage; see `shellOpacity` of hair/opacity.glsl. */
const MOST = 0.996;

/** Steps by halves towards the level: finer than a byte. */
const STEPS = 12;

/** Values told apart. */
const BINS = 256;

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
 * Coverage of each slab that keeps its value where the picture's contrast is raised, 0..1: X for texels of the finest
 * level, Y of the next one, ZW of the next slab. For `crispCoverage` of hair/opacity.glsl.
 *
 * @param textures the slabs of a state after those of the one before; where the processor has no bytes of them all levels
 * are one half
 */
export function crispLevels({ plane0, plane1 }: FurTextures): Vector4[] {
	const { plane, channel } = alphaChannel(plane1 ? 6 : 3);
	const { mipmaps, image } = (plane === 1 ? plane1 : plane0) as CompressedArrayTexture;
	const layers = (image as { depth: number } | null)?.depth ?? 0;
	const levels = Array.from({ length: layers }, (_, k) =>
		SLABS.map((slabs, level) => {
			const found = (mipmaps?.[level] ?? mipmaps?.[0]) as Level | undefined;
			if (!found?.data) return 0.5;
			const { data, width, height } = found;
			const size = data.length / layers;
			return keptLevel(between({ texels: data.subarray(k * size, (k + 1) * size), width, height, channel }), slabs);
		}),
	).flat();
	return Array.from({ length: Math.ceil(layers / 2) }, (_, i) =>
		new Vector4().fromArray([...levels.slice(4 * i, 4 * i + 4), 0, 0]),
	);
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

/** Level c for which clamp((a − c)·COVERAGE_CONTRAST + c, 0, 1) hides as much as a does. @param shares of a's values */
function keptLevel(shares: Float64Array, slabs: number): number {
	const hidden = (change: (a: number) => number) =>
		shares.reduce((sum, share, byte) => {
			const coverage = Math.min(Math.max(change(byte / (BINS - 1)), 0), MOST);
			return sum + share * (1 - (1 - coverage) ** slabs);
		}, 0);
	const wanted = hidden((a) => a);
	let [low, high] = [0, 1];
	for (let step = 0; step < STEPS; step++) {
		const level = (low + high) / 2;
		if (hidden((a) => (a - level) * COVERAGE_CONTRAST + level) > wanted) low = level;
		else high = level;
	}
	return (low + high) / 2;
}
