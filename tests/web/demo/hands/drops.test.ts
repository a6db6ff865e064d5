import { Matrix4, PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { Drops } from '../../../../web/demo/hands/drops.ts';

const camera = new PerspectiveCamera();
const place = new Vector3(0, 1, 0);
const up = new Vector3(0, 1, 0);

describe('a shower', () => {
	it('falls on the place from above, within its radius, and ends soon after the brush has gone', () => {
		const drops = new Drops();
		const matrix = new Matrix4();
		const at = new Vector3();
		let most = 0;
		for (let i = 0; i < 120; i++) {
			drops.pour(place, up, 0.3, 2, 1 / 60);
			expect(drops.step(1 / 60, camera)).toBe(true);
			most = Math.max(most, drops.count);
			for (let k = 0; k < drops.count; k++) {
				drops.getMatrixAt(k, matrix);
				at.setFromMatrixPosition(matrix);
				expect(Math.hypot(at.x, at.z)).toBeLessThanOrEqual(0.3 + 1e-6);
				expect(at.y).toBeGreaterThanOrEqual(1);
				expect(at.y).toBeLessThan(1 + 2 * 1.3);
			}
		}
		expect(most).toBeGreaterThan(15);
		expect(most).toBeLessThanOrEqual(40);
		for (let i = 0; i < 60; i++) drops.step(1 / 60, camera);
		expect(drops.step(1 / 60, camera)).toBe(false);
		expect(drops.visible).toBe(false);
	});
});
