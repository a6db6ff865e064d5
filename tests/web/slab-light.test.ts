import { DataUtils } from 'three';
import { describe, expect, it } from 'vitest';
import { type Curves, KNOTS } from '../../web/fur/format.ts';
import { curveTable, SlabLight, standInWeights } from '../../web/fur/SlabLight.ts';

const table = (q: number, part: number) =>
	[0, 1, 2].map((b) => Array.from({ length: KNOTS }, (_, i) => i / 16 + q + 10 * b + 100 * part));
const curves: Curves = { even: [table(0, 0), table(1, 0)], along: [table(0, 1), table(1, 1)] };

describe('curveTable', () => {
	it('has a curve per channel, knots along x, and both parts at three radii along y', () => {
		const { data, width, height } = curveTable(curves).image;
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
		const light = new SlabLight({ kind: 'ptm' }, means, [[[1, 0]]], 4, false);
		const read = () => Array.from(light.texture.image.data as Float32Array);
		const [first] = [read()];
		light.states = [[[0, 1]]];
		const second = read();
		const before = light.texture;
		light.states = [
			[
				[1, 0],
				[0, 1],
			],
			[
				[0, 1],
				[2, 3],
			],
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

describe('standInWeights', () => {
	it('are those of the places, mixed linearly, and of the last place beyond', () => {
		const weights = [[0], [1], [4], [9]];
		expect(standInWeights(weights, [1, 2.5])).toEqual([[1], [6.5], [6.5], [6.5]]);
		expect(standInWeights(weights, [0, 1, 2, 3])).toEqual(weights);
	});
});
