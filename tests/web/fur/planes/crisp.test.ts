import { describe, expect, it } from 'vitest';
import { crispLevels } from '../../../../web/fur/planes/crisp.ts';
import { textureArray } from '../../../../web/fur/planes/planes.ts';
import { CONTRASTS, coarserShare, crispnessFor, LOD_BIAS } from '../../../../web/fur/shells/lod.ts';

const SIZE = 32;

/** Coverage of soft round hairs on a grid of empty texels; `height` of their middles, 0..255. */
function hairs(size: number, radius: number, height: number): number[] {
	return Array.from({ length: size * size }, (_, i) => {
		const [x, y] = [(i % size) % 8, Math.floor(i / size) % 8];
		return Math.round(height * Math.max(1 - Math.hypot(x - 3.3, y - 3.6) / radius, 0));
	});
}

/** Levels of a plane with this coverage in the blue channel, or in alpha, and noise elsewhere. */
function level(coverage: number[][], channel: number): Uint8Array<ArrayBuffer> {
	return Uint8Array.from(
		coverage.flat().flatMap((a, i) => [0, 1, 2, 3].map((c) => (c === channel ? a : (i * 7) % 256))),
	);
}

/** Share that a slab hides, drawn 4 × 4 times finer with linear filtering, as GPUs do; through `slabs` of it. */
function hidden(coverage: number[], size: number, slabs: number, contrast: number, kept: number, cut = 0): number {
	const at = (x: number, y: number) => (coverage[((y + size) % size) * size + ((x + size) % size)] as number) / 255;
	let sum = 0;
	const fine = 4 * size;
	for (let j = 0; j < fine; j++)
		for (let i = 0; i < fine; i++) {
			const [x, y] = [(i + 0.5) / 4 - 0.5, (j + 0.5) / 4 - 0.5];
			const [left, top] = [Math.floor(x), Math.floor(y)];
			const [u, v] = [x - left, y - top];
			const value =
				(1 - v) * ((1 - u) * at(left, top) + u * at(left + 1, top)) +
				v * ((1 - u) * at(left, top + 1) + u * at(left + 1, top + 1));
			const crisp = Math.min(Math.max((value - kept) * contrast + kept, 0), 1);
			sum += 1 - (1 - (crisp < cut ? 0 : Math.min(crisp, 0.996))) ** slabs;
		}
	return sum / fine ** 2;
}

describe('crisp hairs', () => {
	const slabs = [hairs(SIZE, 3.2, 250), hairs(SIZE, 2.6, 180), hairs(SIZE, 2.2, 120)];
	const coarse = [hairs(SIZE / 2, 2.4, 200), hairs(SIZE / 2, 2, 140), hairs(SIZE / 2, 1.8, 90)];
	const extent = { width: SIZE, height: SIZE, layers: 3 };

	it.each([
		['the second plane', 2],
		['the only plane', 3],
	])('hide as much as soft ones, with coverage in %s', (_, channel) => {
		const plane = textureArray('plane', [level(slabs, channel), level(coarse, channel)], extent);
		const other = textureArray('other', [new Uint8Array(SIZE * SIZE * 12)], extent);
		const planes = channel === 2 ? { plane0: other, plane1: plane } : { plane0: plane };
		const levels = crispLevels(planes, CONTRASTS);
		expect(levels).toHaveLength(8);
		/** Level of a shell of `slabs`, as the shader finds it from the stored numbers. */
		const kept = (at: number, slabs: number) => {
			const [low, high] = [(levels[at] as number) & 65535, (levels[at] as number) >>> 16];
			return (4 * low) / 65535 / (1 + (4 * high * slabs) / 65535);
		};
		for (const k of [0, 1, 2]) {
			for (const [at, one, size, { contrast, cut }] of [
				[2 * k, slabs[k], SIZE, CONTRASTS[0]],
				[2 * k + 1, coarse[k], SIZE / 2, CONTRASTS[1]],
			] as const) {
				// Of many shells, of as many as slabs, and of these seen aslant.
				for (const through of [0.125, 0.25, 0.5, 1, 2, 4]) {
					const soft = hidden(one as number[], size, through, 1, 0);
					const crisp = hidden(one as number[], size, through, contrast, kept(at, through), cut);
					// A little more on purpose.
					expect(crisp / soft, `slab ${k}, contrast ${contrast}, ${through} slabs`).toBeGreaterThan(0.94);
					expect(crisp / soft, `slab ${k}, contrast ${contrast}, ${through} slabs`).toBeLessThan(1.17);
				}
			}
			// With one level for all, hairs seen aslant would get thin, or vanish.
			const [steep, aslant] = [0.25, 4].map((through) => {
				const soft = hidden(slabs[k] as number[], SIZE, through, 1, 0);
				return hidden(slabs[k] as number[], SIZE, through, 2.5, kept(2 * k, 0.25), 0.1) / soft;
			}) as [number, number];
			expect(steep - aslant).toBeGreaterThan(0.15);
		}
	});

	it('are those close up: from afar the picture stays as it was, and nothing jumps', () => {
		expect([0.01, 0.1, 0.29].map(crispnessFor)).toEqual([1, 1, 1]);
		expect(crispnessFor(0.8)).toBeCloseTo(1.75, 6);
		expect([1.4, 5, 100].map(crispnessFor)).toEqual([2.5, 2.5, 2.5]);
		// Of the levels that the shader reads, which are finer than one texel a pixel.
		expect([0.1, 0.5 * 2 ** LOD_BIAS, 1, 4].map(coarserShare)).toEqual([1, 1, 0, 0]);
		for (let pixels = 0.02; pixels < 4; pixels += 0.01) {
			expect(Math.abs(crispnessFor(pixels + 0.01) - crispnessFor(pixels))).toBeLessThan(0.05);
			expect(Math.abs(coarserShare(pixels + 0.01) - coarserShare(pixels))).toBeLessThan(0.05);
		}
	});
});
