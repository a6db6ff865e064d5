import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { parseFur } from '../../../../web/fur/format/extension.ts';
import type { FurAsset } from '../../../../web/fur/format.ts';
import { bentWeights, leanOf } from '../../../../web/fur/light/bent.ts';

const golden = (): FurAsset =>
	JSON.parse(readFileSync(new URL('../../../golden/ptm-6/model.gltf', import.meta.url), 'utf8')).extensions
		.FUR_ptm_shells;

const eight = (first: number) => Array.from({ length: 8 }, (_, i) => first + i);

describe('bentWeights', () => {
	it('are those of any fur where none were baked', () => {
		const fur = golden();
		expect(leanOf(fur).toArray()).toEqual([0, 0.4]);
		const weights = bentWeights(fur).map((part) => part.toArray());
		expect(weights[0]).toEqual([0, -0.2, 0, 0]);
		expect(weights[2]).toEqual([-1.8, 0, 2.7, -1.5]);
		expect([1, 3, 4, 5].flatMap((i) => weights[i])).toEqual(new Array(16).fill(0));
	});

	it('are the baked ones, two vectors a row', () => {
		const fur = { ...golden(), bent: [eight(0), eight(8), eight(16)] };
		expect(parseFur(fur)).toBe(fur);
		expect(bentWeights(fur).flatMap((part) => part.toArray())).toEqual(Array.from({ length: 24 }, (_, i) => i));
	});

	it.each([2, 4])('are refused in %d rows', (rows) => {
		expect(() => parseFur({ ...golden(), bent: Array.from({ length: rows }, () => eight(0)) })).toThrow(/bent/);
	});
});
