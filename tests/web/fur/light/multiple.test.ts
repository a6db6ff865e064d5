import { describe, expect, it } from 'vitest';
import type { FurAsset } from '../../../../web/fur/format.ts';
import { FurColors, gainOf, shareOf, skyShares } from '../../../../web/fur/light/multiple.ts';
import { coloured, multiple } from './multiple.ts';

const seen = FurColors.of(coloured as FurAsset);

describe('light that has met several hairs', () => {
	it('is that of the samples between hairs of their grey, and a geometric series between others', () => {
		expect(gainOf(multiple, 0, 0.8)).toBeCloseTo(1, 9);
		expect(gainOf(multiple, 1, 0.8)).toBeCloseTo(1, 9);
		const orders = (colour: number) =>
			Array.from({ length: 400 }, (_, n) => colour * (0.5 * colour) ** n).reduce((sum, part) => sum + part, 0);
		for (const colour of [0, 0.1, 0.5, 0.95])
			expect(gainOf(multiple, 1, colour)).toBeCloseTo(orders(colour) / orders(0.8), 6);
		// White hairs lose no light to each other, but there is no end of it either.
		expect(gainOf(multiple, 0, 1)).toBe(gainOf(multiple, 0, 0.98));
	});

	it('has a share by the height of the light and the body, within 0 and 1', () => {
		expect(shareOf(multiple, 0, 1, 4)).toBeCloseTo(0.5, 9);
		expect(shareOf(multiple, 0, 0.25, 4)).toBeCloseTo(0.75, 9);
		expect(shareOf(multiple, 0, -0.5, 4)).toBe(1);
		expect(shareOf(multiple, 1, 0.3, 16)).toBeCloseTo(0.25 + (0.1 * 45) / 33, 9);
		expect(shareOf({ ...multiple, shares: [[-1, 0, 0]] }, 0, 0.3, 4)).toBe(0);
	});

	it('has one share under a sky: the mean of all lights, each by what it gives', () => {
		const { curves, pelts } = coloured;
		if (!curves) throw new Error('no curves');
		const shares = skyShares(multiple, { curves, way: [0, 1] }, pelts[0]?.weights ?? [], 4);
		expect(shares[1]).toBeCloseTo(0.35, 6);
		expect(shares[0]).toBeGreaterThan(0.5);
		expect(shares[0]).toBeLessThan(0.8);
	});
});

describe('FurColors', () => {
	it('are those of the hairs where all are of the grey of the samples', () => {
		const plain = new FurColors({ ...multiple, tint: [1, 1] }, [0.5, 0.3]);
		expect(plain.seen(0.8)).toBeCloseTo(0.8, 9);
		expect(plain.seen(0)).toBe(0);
	});

	it('darken, and come back', () => {
		for (let colour = 0.05; colour < 0.75; colour += 0.1) {
			const there = seen?.seen(colour) ?? Number.NaN;
			expect(there).toBeLessThan(colour);
			expect(seen?.hairs(there)).toBeCloseTo(colour, 9);
		}
		expect(seen?.hairs(9)).toBeCloseTo(1, 9);
	});

	it('are not told by assets without mean curves or numbers of them', () => {
		expect(FurColors.of({ pelts: coloured.pelts } as FurAsset)).toBeUndefined();
	});
});
