import { PerspectiveCamera, Vector2, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { directionUnder } from '../../../web/page/aim.ts';

const centre = new Vector3(0.4, -0.2, 0.1);
const radius = 1.3;
const camera = new PerspectiveCamera(26, 1.5, 0.1, 100);
camera.position.set(3, 2, 6);
camera.lookAt(centre);
camera.updateMatrixWorld();

const under = (x: number, y: number) => directionUnder(new Vector2(x, y), camera, centre, radius, new Vector3());
/** Where a lamp in this direction is seen, normalised device coordinates. */
const seen = (direction: Vector3) => centre.clone().addScaledVector(direction, radius).project(camera);
const towardsCamera = camera.position.clone().sub(centre).normalize();

describe('the direction under a finger', () => {
	it('puts the lamp exactly under the finger, on the near side', () => {
		for (const [x, y] of [
			[0, 0],
			[0.3, 0.2],
			[-0.25, 0.5],
			[0.1, -0.6],
		] as const) {
			const direction = under(x, y);
			expect(direction.length()).toBeCloseTo(1, 12);
			expect(seen(direction).x).toBeCloseTo(x, 9);
			expect(seen(direction).y).toBeCloseTo(y, 9);
			expect(direction.dot(towardsCamera)).toBeGreaterThan(0);
		}
	});

	// The sphere's rim is steep: 0.001 there is 0.1 radians.
	it('runs on without a jump over the rim to straight behind', () => {
		let before = under(0, 0);
		for (let x = 0; x <= 1.6; x += 0.001) {
			const direction = under(x, 0);
			expect(direction.angleTo(before)).toBeLessThan(0.12);
			before = direction;
		}
		expect(before.dot(towardsCamera)).toBeLessThan(-0.85);
	});
});
