/** The shadow on the ground lies where the lamp's map has it, and is as dark as the lamp is strong there. */

import { Box3, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { CastShadow } from '../../../web/page/backdrop.ts';

const box = new Box3(new Vector3(-1, 0, -1), new Vector3(1, 2, 1));
const centre = box.getCenter(new Vector3());

function lit(x: number, y: number, z: number, share = 0.8): { shadow: CastShadow; direction: Vector3 } {
	const shadow = new CastShadow();
	const direction = new Vector3(x, y, z).normalize();
	shadow.fit(box, 0.2);
	shadow.follow(centre, 1.7, direction, share);
	return { shadow, direction };
}

describe('the shadow on the ground', () => {
	it('takes in all that a ball of the radius shades', () => {
		const { shadow, direction } = lit(0.7, 0.5, -0.3);
		for (let i = 0; i < 200; i++) {
			const point = new Vector3().setFromSphericalCoords(1.69, Math.acos(1 - (2 * i + 1) / 200), 2.4 * i).add(centre);
			point.addScaledVector(direction, (shadow.position.y - point.y) / direction.y);
			expect(point.distanceTo(shadow.position)).toBeLessThanOrEqual(shadow.scale.x);
		}
		expect(shadow.position.y).toBeCloseTo(-0.1);
	});

	it('is darker the greater the share of the lamp, and gone before the lamp sets', () => {
		const dark = (y: number, share: number) => lit(0.5, y, 0, share).shadow.material.opacity;
		expect(dark(1, 0.8)).toBeCloseTo(2 * dark(1, 0.4));
		expect(dark(1, 0.8)).toBeLessThan(0.8);
		expect(dark(0.12, 0.8)).toBeGreaterThan(0);
		expect(dark(0.12, 0.8)).toBeLessThan(0.5 * dark(1, 0.8));
		for (const y of [0.05, 0, -1]) expect(dark(y, 0.8)).toBe(0);
	});
});
