/** Highlights leave a fur its colour: their strength goes by the tips of the shipped furs. */

import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { DEFAULT_LOOK, glossOf } from '../../../web/page/look.ts';

const furOf = (name: string) =>
	JSON.parse(readFileSync(new URL(`../../../public/models/${name}/model.gltf`, import.meta.url), 'utf8')).extensions
		.FUR_ptm_shells;

describe('the strength of highlights', () => {
	it.each(['bunny', 'pelt-paper', 'pelt-wolf', 'pelt-sheep'])('is the usual one on the pale tips of %s', (name) => {
		expect(glossOf(furOf(name))).toBe(DEFAULT_LOOK.gloss);
	});

	it.each(['pelt-fox', 'tiger'])('is less than half on deep tips and on a picture: %s', (name) => {
		expect(glossOf(furOf(name))).toBeCloseTo(0.1, 12);
	});

	it('lies between them on tips between, and is a number on black ones', () => {
		const between = glossOf({ ramp: { tip: [1, 0.6, 0.3] } });
		expect(between).toBeGreaterThan(0.1);
		expect(between).toBeLessThan(DEFAULT_LOOK.gloss);
		expect(glossOf({ ramp: { tip: [0, 0, 0] } })).toBeCloseTo(0.1, 12);
	});
});
