import { describe, expect, it } from 'vitest';
import { hiddenShares, SlabMeans, type Slabs, standIns } from '../../../../web/fur/light/trim.ts';

const LAYERS = 4;
const TEXELS = 9; // of a slab

/** Bytes that look like chance, and how they are decoded. */
const slabs: Slabs = {
	planes: [
		[37, 11, 5],
		[53, 29, 7],
	].map(([a = 0, b = 0, c = 0]) =>
		Uint8Array.from({ length: LAYERS * TEXELS * 4 }, (_, i) => (a * i * i + b * i + c) % 251),
	),
	scale: [0.01, 0.02, 0.015, 0.01, 0.03, 0.008],
	bias: [100, 90, 120, 80, 128, 10],
	layers: LAYERS,
};

/** Coefficients of a texel. */
function coefficients(slab: number, texel: number): number[] {
	const at = 4 * (slab * TEXELS + texel);
	const [p0, p1] = slabs.planes as [Uint8Array, Uint8Array];
	const bytes = [p0[at], p0[at + 1], p0[at + 2], p1[at], p1[at + 1], p0[at + 3]] as number[];
	return bytes.map((byte, i) => (slabs.scale[i] ?? 0) * (byte - (slabs.bias[i] ?? 0)));
}

const dot = (a: readonly number[], b: readonly number[]) => a.reduce((sum, value, i) => sum + value * (b[i] ?? 0), 0);

/** Moments of a slab as the shader changes them. */
function changed(table: Float32Array, slab: number, moments: readonly number[]): number[] {
	const six = (column: number) => [0, 1, 2, 4, 5, 6].map((i) => table[16 * slab + column + i] ?? 0);
	const by = dot(six(8), moments);
	return moments.map((m, i) => m + (six(0)[i] ?? 0) * by);
}

describe('hidden fur', () => {
	/** Fur of one texel a slab, of this coverage, lowest first. */
	const fur = (...coverage: number[]): Slabs => ({
		planes: [Uint8Array.from(coverage.flatMap((alpha) => [0, 0, 0, 255 * alpha]))],
		scale: [1, 1, 1],
		bias: [0, 0, 0],
		layers: coverage.length,
	});

	const hiddenShare = (slabs: Slabs, share: number) => hiddenShares(slabs, share)[0] as number;

	it('ends where .15 of the view from above is left', () => {
		// The slabs have 0, .2, 0 and .8 of the view: three quarters of the second one are hidden.
		expect(hiddenShare(fur(0, 1, 0, 0.8), 1)).toBeCloseTo(1.75 / 4, 9);
		expect(hiddenShare(fur(1, 1, 1, 1), 1)).toBeCloseTo(3.15 / 4, 9);
		expect(hiddenShare(fur(1, 0, 0, 0), 1)).toBeCloseTo(0.15 / 4, 9);
	});

	it('is faint higher up', () => {
		expect(hiddenShares(fur(1, 1, 1, 1), 1)[1]).toBeCloseTo(3.4 / 4, 9);
		expect(hiddenShares(fur(0, 0, 0, 1), 0.5)).toEqual([0, 0]);
	});

	it('is less of cut fur, whose lowest hairs have nothing above them', () => {
		const dense = fur(0.6, 0.6, 0.6, 0.6);
		expect(2 * hiddenShare(dense, 0.5)).toBeLessThan(4 * hiddenShare(dense, 1));
		expect(hiddenShare(fur(0, 0, 0, 1), 0.5)).toBe(0);
	});
});

describe('cut fur', () => {
	it('has each slab stand in for the one in whole fur above which as much is seen, as furbake trim has it', () => {
		expect([...standIns(slabs, 1)]).toEqual([0, 1, 2, 3].map((k) => expect.closeTo(k, 9)));
		expect([...standIns(slabs, 0.5)]).toEqual([1.16621409, 2.76775584].map((k) => expect.closeTo(k, 6)));
		expect([...standIns(slabs, 0.75)]).toEqual([0.2879041, 1.42426227, 2.79582829].map((k) => expect.closeTo(k, 6)));
	});

	it('has a slab that is cut through, too, and goes over evenly to one less', () => {
		const [lower = 0, upper = 0] = standIns(slabs, 0.5 + 1e-4);
		const [alone = 0, next = 0] = standIns(slabs, 0.5);
		expect(standIns(slabs, 0.6)).toHaveLength(3);
		expect(lower).toBeCloseTo(alone, 2);
		expect(upper).toBeCloseTo(next, 2);
	});

	it('has the light that furbake trim measures', () => {
		const table = new Float32Array(16 * LAYERS);
		new SlabMeans(slabs).fill(standIns(slabs, 0.5), table);
		const moments = changed(table, 1, [0.3, 0.2, -0.1, 0.4, -0.2, 1]);
		const light = [0, 1, 2, 3].map((texel) => dot(coefficients(1, texel), moments));
		expect(light).toEqual([2.74259563, 0.95783556, 1.35731653, 0.6442841].map((value) => expect.closeTo(value, 4)));
	});

	it('is lit as ever where nothing is cut off', () => {
		const table = new Float32Array(16 * LAYERS).fill(1);
		new SlabMeans(slabs).fill(standIns(slabs, 1), table);
		const moments = [0.3, 0.2, -0.1, 0.4, -0.2, 1];
		for (const slab of [0, 1, 2, 3])
			expect(changed(table, slab, moments)).toEqual(moments.map((value) => expect.closeTo(value, 5)));
	});
});
