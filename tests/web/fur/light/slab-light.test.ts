import { DataUtils } from 'three';
import { describe, expect, it } from 'vitest';
import { type Curves, KNOTS } from '../../../../web/fur/format.ts';
import { curveSkies } from '../../../../web/fur/light/curves.ts';
import { skyShares } from '../../../../web/fur/light/multiple.ts';
import { curveTable, SlabLight, standInState, standInWeights } from '../../../../web/fur/light/SlabLight.ts';
import { coloured, multiple } from './multiple.ts';

const table = (q: number, part: number) =>
	[0, 1, 2].map((b) => Array.from({ length: KNOTS }, (_, i) => i / 16 + q + 10 * b + 100 * part));
const curves: Curves = { even: [table(0, 0), table(1, 0)], along: [table(0, 1), table(1, 1)] };

describe('curveTable', () => {
	it('has a curve per channel, knots along x, and both parts at three radii along y', () => {
		const { data, width, height } = curveTable([curves]).image;
		expect([width, height]).toEqual([17, 6]);
		const at = (row: number, knot: number, channel: number) =>
			DataUtils.fromHalfFloat((data as Uint16Array)[4 * (17 * row + knot) + channel] ?? 0);
		expect(at(0, 16, 0)).toBe(1);
		expect(at(2, 8, 1)).toBe(21.5);
		expect(at(4, 0, 1)).toBe(111);
		expect(at(4, 0, 2)).toBe(0);
	});
});

describe('SlabLight', () => {
	const means = { curves, way: [0, 1] as const };

	it('has a row per slab and state, linear in its weights', () => {
		const light = new SlabLight({ kind: 'ptm' }, [means], [{ weights: [[1, 0]] }], false);
		const read = () => Array.from(light.texture.image.data as Float32Array);
		const [first] = [read()];
		light.states = [{ weights: [[0, 1]] }];
		const second = read();
		const before = light.texture;
		light.states = [
			{
				weights: [
					[1, 0],
					[0, 1],
				],
			},
			{
				weights: [
					[0, 1],
					[2, 3],
				],
			},
		];
		expect(light.texture).not.toBe(before);
		const rows = read();
		const row = rows.length / 4;
		expect(rows.slice(0, row)).toEqual(first);
		expect(rows.slice(row, 3 * row)).toEqual([...second, ...second]);
		rows.slice(3 * row).forEach((value, i) => {
			expect(value).toBeCloseTo(2 * (first?.[i] ?? 0) + 3 * (second[i] ?? 0), 3);
		});
	});
});

describe('what is told of several hairs', () => {
	const state = { weights: [[1], [2]], multiple };

	it('is in the last three texels of its slab', () => {
		const { curves: own } = coloured;
		if (!own) throw new Error('no curves');
		const light = new SlabLight({ kind: 'ptm' }, [{ curves: own, way: [0, 1] }], [state], false);
		const data = light.texture.image.data as Float32Array;
		const second = data.slice(data.length - 12);
		const close = (values: number[]) => values.map((value) => expect.closeTo(value, 5));
		expect([...second]).toEqual(close([0.25, 0, 0.1, 0, 0.5, 0.6 / 0.8, 0.9, 0, 0, 0, 0, 0]));
	});

	it('is of an even sky beside its harmonics, at every radius', () => {
		const { curves: own } = coloured;
		if (!own) throw new Error('no curves');
		const means = { curves: own, way: [0, 1] as const };
		const data = new SlabLight({ kind: 'ptm' }, [means], [state], false).texture.image.data as Float32Array;
		for (const [b, radius] of [1, 4, 16].entries()) {
			const [sky] = curveSkies({ kind: 'ptm' }, means, radius);
			const shares = skyShares(multiple, means, state.weights, radius);
			for (const [k, [weight = 0]] of state.weights.entries()) {
				const texel = (i: number) => [...data.slice(4 * (64 * k + 14 * b + i), 4 * (64 * k + 14 * b + i + 1))];
				const close = (values: number[]) => values.map((value) => expect.closeTo(weight * value, 4));
				sky?.environment.forEach((row, c) => {
					expect(texel(1 + c)).toEqual(close(row.slice(0, 4)));
					expect(texel(7 + c)).toEqual(close(row.slice(4, 8)));
					expect(texel(13 + Math.floor(c / 3))[c % 3]).toBeCloseTo(weight * (row[8] ?? Number.NaN), 4);
				});
				expect(texel(13)[3]).toBeCloseTo(shares[k] ?? Number.NaN, 5);
			}
		}
	});

	it('changes with cut fur, but for what its own hairs are', () => {
		const cut = standInState(state, [0.5, 1]);
		expect(cut.weights).toEqual([[1.5], [2]]);
		expect(cut.multiple?.shares[0]).toEqual([0.625, -0.25, 0.05]);
		expect(cut.multiple?.ratio).toEqual([0.75, 0.5]);
		expect(cut.multiple?.tint).toEqual(multiple.tint);
	});
});

describe('standInWeights', () => {
	it('are those of the places, mixed linearly, and of the last place beyond', () => {
		const weights = [[0], [1], [4], [9]];
		expect(standInWeights(weights, [1, 2.5])).toEqual([[1], [6.5], [6.5], [6.5]]);
		expect(standInWeights(weights, [0, 1, 2, 3])).toEqual(weights);
	});
});
