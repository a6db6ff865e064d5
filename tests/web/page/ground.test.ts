/** The ground lies under the body, faces up and fades out; the shadow of the sky follows the body. */

import { Box3, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { ContactShadow, Ground } from '../../../web/page/ground.ts';

const box = new Box3(new Vector3(-1, 0, -1), new Vector3(1, 2, 1));

describe('the ground', () => {
	const ground = new Ground();
	ground.fit(box, -0.1, 5);
	ground.updateMatrixWorld();
	const position = ground.geometry.getAttribute('position');
	const colour = ground.geometry.getAttribute('color');
	const points = Array.from({ length: position.count }, (_, i) => ({
		at: new Vector3().fromBufferAttribute(position, i).applyMatrix4(ground.matrixWorld),
		alpha: colour.getW(i),
	}));

	it('lies where the fur of the body ends, below the shadow of the sky', () => {
		const shadow = new ContactShadow();
		shadow.fit(box, 0.2, -0.1);
		for (const { at } of points) {
			expect(at.y).toBeCloseTo(-0.1, 2);
			expect(at.y).toBeLessThan(shadow.position.y);
		}
		expect(ground.renderOrder).toBeLessThan(shadow.renderOrder);
	});

	it('is whole under the body and gone at its rim', () => {
		for (const { at, alpha } of points) {
			const away = Math.hypot(at.x, at.z);
			if (away < 0.5) expect(alpha).toBe(1);
			if (away > 4.999) expect(alpha).toBeCloseTo(0);
		}
		expect(Math.max(...points.map(({ at }) => Math.hypot(at.x, at.z)))).toBeCloseTo(5);
	});

	it('is seen from above', () => {
		const index = ground.geometry.index;
		const corner = (i: number) => points[index?.getX(i) ?? 0]?.at ?? new Vector3();
		for (let face = 0; face < (index?.count ?? 0); face += 3) {
			const [a, b, c] = [corner(face), corner(face + 1), corner(face + 2)];
			expect(b.clone().sub(a).cross(c.clone().sub(a)).y).toBeGreaterThanOrEqual(0);
		}
	});
});

describe('the shadow of the sky', () => {
	it('follows the body and pales as it rises', () => {
		const shadow = new ContactShadow();
		shadow.fit(box, 0, 0);
		const dark = shadow.material.opacity;
		shadow.follow(new Vector3(3, 1, -2), 0.5, 2);
		expect(shadow.position.toArray()).toEqual([3, 0, -2]);
		expect(shadow.rotation.z).toBe(0.5);
		expect(shadow.material.opacity).toBeCloseTo(dark * Math.exp(-1.5));
	});
});
