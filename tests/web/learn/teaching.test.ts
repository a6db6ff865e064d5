/** Figures that teach: parabolas by hand, and the numbers behind the answers. */

import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { errorOf, parabolaOf, valueAt } from '../../../web/learn/byhand/parabola.ts';
import { decodeLayer, type LessonRecord } from '../../../web/learn/data/measurements.ts';
import { lostAtHorizon } from '../../../web/learn/guide/sinking.ts';
import { WORDS } from '../../../web/learn/words/index.ts';

const file = (name: string) => readFileSync(new URL(`../../../public/lesson/${name}`, import.meta.url));
const record: LessonRecord = JSON.parse(file('lesson.json').toString());
const planes = record.planes.map((name) => file(name));

describe('parabolas', () => {
	it('go through three points', () => {
		const points = [
			[-0.8, 0.3],
			[0, 2],
			[0.8, 1.1],
		] as const;
		for (const [x, y] of points) expect(valueAt(parabolaOf(points), x)).toBeCloseTo(y);
		expect(errorOf(parabolaOf(points), points)).toBeCloseTo(0);
	});

	it('of least squares are closer than any near them', () => {
		const points = Array.from({ length: 15 }, (_, i) => [i / 7 - 1, Math.abs(Math.sin(3 * i))] as const);
		const best = parabolaOf(points);
		for (const by of [-0.01, 0.01])
			for (const at of [0, 1, 2]) {
				const other = best.map((value, i) => value + (i === at ? by : 0)) as unknown as typeof best;
				expect(errorOf(other, points)).toBeGreaterThan(errorOf(best, points));
			}
	});

	it.each(['en', 'zh'] as const)('are written with one sign a term, in %s', (language) => {
		const said = WORDS[language].hair.says(['−2.10', '−0.20', '1.30'], '0.40', '0.30');
		expect(said).toContain('L = −2.10·lᵥ² − 0.20·lᵥ + 1.30');
		expect(said).not.toContain('+ −');
	});
});

describe('light that a layer loses at the horizon', () => {
	it('is what brute force over its texels says, and more in the depths', () => {
		const lost = record.samples.map((sample, i) => {
			const layer = decodeLayer(record, i, file(sample.file), planes);
			const lamps = record.lights.slice(0, record.fitted + record.held_out);
			const weights = layer.texels.map((texel) => layer.alpha[texel] ?? 0);
			const whole = weights.reduce((sum, weight) => sum + weight, 0);
			const means = lamps.map((_, lamp) =>
				weights.reduce((sum, weight, t) => sum + (weight * (layer.light[lamp * weights.length + t] ?? 0)) / whole, 0),
			);
			const over = (kept: (degrees: number) => boolean) => {
				const some = means.filter((_, lamp) => kept((Math.asin(lamps[lamp]?.[2] ?? 0) * 180) / Math.PI));
				return some.reduce((sum, mean) => sum + mean, 0) / some.length;
			};
			const expected = 1 - over((degrees) => degrees < 15) / over((degrees) => degrees > 75);
			expect(lostAtHorizon(layer, lamps)).toBeCloseTo(expected, 5);
			return expected;
		});
		expect(lost[0]).toBeGreaterThan(lost.at(-1) ?? 1);
	});
});
