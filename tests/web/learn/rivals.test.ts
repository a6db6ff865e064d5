import { MathUtils, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { LAMP_NAMES, lampOf, nearestLamp } from '../../../web/learn/rivals/truth.ts';
import view from '../../../web/learn/rivals/view.json';
import { FIELD_OF_VIEW } from '../../../web/learn/view.ts';

describe('the truth beside the rivals', () => {
	it('was traced in the angle of view of the figures', () => {
		expect(view.eye.fieldOfView).toBe(FIELD_OF_VIEW);
	});

	it('has a lamp next to every direction: its own, where it is one of them', () => {
		for (const name of LAMP_NAMES) {
			expect(lampOf(name).length()).toBeCloseTo(1, 12);
			expect(nearestLamp(lampOf(name))).toEqual({ name, off: expect.closeTo(0, 4) });
			const turned = lampOf(name).applyAxisAngle(new Vector3(1, 0, 0), MathUtils.degToRad(10));
			expect(nearestLamp(turned)).toEqual({ name, off: expect.any(Number) });
		}
		expect(nearestLamp(new Vector3(0, 1, 0.01).normalize()).off).toBeCloseTo(MathUtils.radToDeg(Math.atan(0.01)), 6);
	});
});
