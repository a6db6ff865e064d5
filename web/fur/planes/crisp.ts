/**
 * Crisp hairs: where coverage is blended between texels as large as pixels, hairs are broad and half transparent. More
 * contrast around one level of each slab makes them narrow and opaque, and fur hides as much.
 */

import { type CompressedArrayTexture, Vector4 } from 'three';
import { alphaChannel } from '../format.ts';
import type { FurTextures } from '../light/texels.ts';

/**
 * Slabs that a ray to the eye crosses in a shell, where texels are larger than pixels and where they are smaller: magnified
 * fur has more shells.
 */
const SLABS = [0.5, 1.4] as const;

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
 * @param contrast at which fur hides as much as without; at others it nearly does
 * @param cut coverage below which nothing is drawn at that contrast
 */
export function crispLevels({ plane0, plane1 }: FurTextures, contrast: number, cut: number): Vector4[] {
	const { plane, channel } = alphaChannel(plane1 ? 6 : 3);
	const { mipmaps, image } = (plane === 1 ? plane1 : plane0) as CompressedArrayTexture;
	const layers = (image as { depth: number } | null)?.depth ?? 0;
	const levels = Array.from({ length: layers }, (_, k) =>
		SLABS.map((slabs, level) => {
			const found = (mipmaps?.[level] ?? mipmaps?.[0]) as Level | undefined;
			if (!found?.data) return 0.5;
			const { data, width, height } = found;
			const size = data.length / layers;
			const texels = data.subarray(k * size, (k + 1) * size);
			return keptLevel(between({ texels, width, height, channel }), slabs, contrast, cut);
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

/**
 * Level c at which clamp((a − c)·contrast + c, 0, 1), without what is cut, hides as much as a.
 *
 * @param shares of a's values
 */
function keptLevel(shares: Float64Array, slabs: number, contrast: number, cut: number): number {
	const hidden = (change: (a: number) => number) =>
		shares.reduce((sum, share, byte) => sum + share * (1 - Math.max(1 - change(byte / (BINS - 1)), 0) ** slabs), 0);
	const wanted = hidden((a) => a);
	let [low, high] = [0, 1];
	for (let step = 0; step < STEPS; step++) {
		const level = (low + high) / 2;
		const crisp = (a: number) => (a - level) * contrast + level;
		if (hidden((a) => (crisp(a) < cut ? 0 : crisp(a))) > wanted) low = level;
		else high = level;
	}
	return (low + high) / 2;
}
