import { describe, expect, it } from 'vitest';
import { distanceFor, FIELD_OF_VIEW } from '../../../web/learn/view.ts';
import { lampDistance } from '../../../web/page/lamp/lamp.ts';

describe('distance of the eye', () => {
	const half = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
	/** Outline of the lamp's sphere over half of the picture's width. */
	const share = (aspect: number, distance: number) => Math.tan(Math.asin(lampDistance / distance)) / (half * aspect);

	it.each([0.8, 1, 1.25, 1.6, 16 / 7])('keeps the lamp within a picture of aspect %d, however near', (aspect) => {
		for (const zoom of [1, 1.5, 4]) expect(share(aspect, distanceFor(aspect, zoom))).toBeLessThan(1);
	});

	it('goes as near as asked without a lamp, and where there is room', () => {
		expect(share(1.25, distanceFor(1.25, 1.8, false))).toBeGreaterThan(1.3);
		expect(distanceFor(16 / 7, 1)).toBeCloseTo(1.5 * distanceFor(16 / 7, 1.5), 9);
	});
});
