import { describe, expect, it } from 'vitest';
import { coverages, factorOf, factorSeen, sharesSeen, surgeOf, termsOf, type Way } from '../../../web/learn/nap/law.ts';
import { rimFor } from '../../../web/learn/nap/polar.ts';

const way = (around: number, up: number): Way => {
	const [a, e] = [(around * Math.PI) / 180, (up * Math.PI) / 180];
	return [Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e)];
};
const above: Way = [0, 0, 1];
const rows = (weights: Record<number, [number, number, number]>) =>
	[0, 1, 2].map((row) => Array.from({ length: 16 }, (_, f) => weights[f]?.[row] ?? 0));

describe('the law of light and eye', () => {
	it('has the terms of the bake, in its order', () => {
		const [light, eye]: [Way, Way] = [
			[0.6, 0, 0.8],
			[0.36, 0.48, 0.8],
		];
		// In the order that `termsOf` tells, with a = .216, b = .6, p = .36, z = .8, q = .36.
		const terms = [0.36, 0.216, 0.216, 0.216, 0.288, 0.1296, 0.36, 0.046656, 0.046656, 0.1296, 0.1728, 0.046656];
		terms.push(0.1728, 0.288, 0.2304, 0.07776);
		expect(termsOf(light, eye)).toHaveLength(terms.length);
		for (const [f, term] of termsOf(light, eye).entries()) expect(term, `term ${f}`).toBeCloseTo(terms[f] ?? 0, 10);
	});

	it('is 1 straight above, whatever the numbers', () => {
		const numbers = [0, 1, 2].map((row) => Array.from({ length: 16 }, (_, f) => Math.sin(5 * row + f)));
		for (const light of [above, way(40, 10), way(200, 60)])
			expect(factorOf(numbers, light, above, 0.7)).toBeCloseTo(1, 10);
	});

	it('is a parabola over the height, and never less than a tenth', () => {
		const eye = way(0, 30);
		const numbers = rows({ 0: [0.2, -0.4, 0.8] });
		for (const s of [0, 0.5, 1])
			expect(factorOf(numbers, above, eye, s)).toBeCloseTo(1 + 0.75 * (0.2 - 0.4 * s + 0.8 * s * s), 10);
		expect(factorOf(rows({ 0: [-5, 0, 0] }), above, eye, 0.5)).toBe(0.1);
	});

	it('surges beside the lamp, more from aside', () => {
		const surge = [0.2, 0.4, 0.1] as const;
		expect(surgeOf(surge, above, above)).toBeCloseTo(1.2, 10);
		expect(surgeOf(surge, way(0, 30), way(0, 30))).toBeCloseTo(1.2 + 0.4 * 0.75, 10);
		const half = 2 * Math.asin(0.05) * (180 / Math.PI);
		expect(surgeOf(surge, way(0, 30 + half), way(0, 30))).toBeCloseTo(1 + 0.5 * 0.5, 10);
		expect(surgeOf(surge, way(180, 20), way(0, 20))).toBeLessThan(1.01);
	});
});

describe('what an eye sees of the fur', () => {
	it('is told by the bytes of α', () => {
		// Two layers of 2 × 2 texels.
		const bytes = new Uint8Array(32);
		for (const [texel, alpha] of [0, 255, 0, 255, 51, 51, 51, 51].entries()) bytes[4 * texel + 2] = alpha;
		expect(coverages({ layers: 2, size: 2 }, bytes, 2)).toEqual([0.5, expect.closeTo(0.2, 10)]);
	});

	it('is all of it, the higher slabs more from aside', () => {
		const covers = [0.9, 0.5, 0.2];
		const [straight, aside] = [1, 0.3].map((up) => sharesSeen(covers, up)) as [number[], number[]];
		for (const shares of [straight, aside]) expect(shares.reduce((a, b) => a + b)).toBeCloseTo(1, 10);
		expect((straight[1] ?? 0) / (straight[2] ?? 1)).toBeCloseTo((0.8 * 0.5) / 0.2, 10);
		expect(aside[2]).toBeGreaterThan(1.5 * (straight[2] ?? 1));
	});

	it('has the factor of its heights', () => {
		// Of the two slabs, at s = 1/4 and 3/4, the upper one hides the lower.
		const asset = { eye: rows({ 0: [0, 0.4, 0] }) };
		expect(factorSeen(asset, [0.5, 1], above, way(0, 30))).toBeCloseTo(1 + 0.75 * 0.4 * 0.75, 6);
		expect(factorSeen(asset, [0.5, 0], above, way(0, 30))).toBeCloseTo(1 + 0.75 * 0.4 * 0.25, 6);
	});
});

describe('the rim of a polar plot', () => {
	const rim = (most: number) =>
		rimFor({ factor: (angle) => (angle === 90 ? most : 1), eye: 0, light: 0, lean: [0, 0] }, 0, 180);

	it('is at 2, or as far out as the curve needs', () => {
		expect([0.5, 2, 2.01, 3.4].map(rim)).toEqual([2, 2, 3, 4]);
	});
});
