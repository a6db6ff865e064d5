import { describe, expect, it } from 'vitest';
import { crisp } from '../../../../web/fur/planes/crisp.ts';
import { mipLevels, type PlaneBytes } from '../../../../web/fur/planes/planes.ts';

const SIZE = 32;

/** Coverage of thin hairs on a grid, each a soft spot on empty texels; fewer and fainter in every further slab. */
function hairs(slabs: number): number[][] {
	return Array.from({ length: slabs }, (_, k) => {
		const [spacing, faint] = [6 + 2 * k, 1 - 0.3 * k];
		return Array.from({ length: SIZE * SIZE }, (_, i) => {
			const [x, y] = [(i % SIZE) % spacing, Math.floor(i / SIZE) % spacing];
			return Math.round(faint * 220 * Math.max(1 - Math.hypot(x - 2.3, y - 2.6) / 2.2, 0));
		});
	});
}

/** A plane with this coverage in a channel and noise in the others. */
function planeOf(coverage: number[][], channel: number): PlaneBytes {
	return Uint8Array.from(coverage.flat().flatMap((a, i) => [0, 1, 2, 3].map((c) => (c === channel ? a : (i * 7) % 256))));
}

const slabOf = (plane: PlaneBytes, k: number, channel: number) =>
	Array.from({ length: SIZE * SIZE }, (_, i) => plane[(k * SIZE * SIZE + i) * 4 + channel] as number);
const mean = (values: number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;

describe('crisp hairs', () => {
	const coverage = hairs(3);

	it.each([2, 3])('cover as much of every slab, with coverage in channel %i', (channel) => {
		const plane = planeOf(coverage, channel);
		const done = crisp(plane, 3, channel);
		for (const [k, slab] of coverage.entries()) {
			const got = slabOf(done, k, channel);
			expect(Math.abs(mean(got) - mean(slab))).toBeLessThan(0.01 * mean(slab) + 0.1);
			// Fewer texels are covered by half: hairs are narrower, their middles cover more.
			const [half, before] = [got, slab].map((values) => values.filter((a) => a > 20 && a < 200).length);
			expect(half).toBeLessThan(0.6 * (before as number));
			expect(Math.max(...got)).toBeGreaterThan(Math.max(...slab));
			expect(got.filter((a, i) => a > 0 && slab[i] === 0)).toEqual([]);
		}
		const others = (bytes: PlaneBytes) => bytes.filter((_, i) => i % 4 !== channel);
		expect(others(done)).toEqual(others(plane));
		expect(plane).toEqual(planeOf(coverage, channel));
	});

	it('leave empty, full and even slabs as they are', () => {
		for (const byte of [0, 90, 255]) {
			const plane = planeOf([new Array(SIZE * SIZE).fill(byte)], 2);
			const got = slabOf(crisp(plane, 1, 2), 0, 2);
			expect(Math.abs(mean(got) - byte)).toBeLessThanOrEqual(1.5);
		}
	});

	it('are near: only the finest levels change', () => {
		const planes = () => [planeOf(coverage, -1), planeOf(coverage, 2)];
		const extent = { width: SIZE, height: SIZE, layers: 3 };
		const [soft, near] = [undefined, 2].map((levels) =>
			mipLevels(planes(), extent, 6, { cut: 0.1, rise: 0.5, crisp: levels }),
		);
		expect(near?.slice(2)).toEqual(soft?.slice(2));
		for (const level of [0, 1]) {
			expect(near?.[level]?.[0]).toEqual(soft?.[level]?.[0]);
			expect(near?.[level]?.[1]).not.toEqual(soft?.[level]?.[1]);
		}
	});
});
