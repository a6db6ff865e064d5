import { DirectionalLight, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { Lamps } from '../../../../web/demo/stage/lamps.ts';
import { MAX_LAMPS } from '../../../../web/demo/state/view.ts';

const directions = (lamps: Lamps) => {
	lamps.updateMatrixWorld(true);
	return lamps.children.map((lamp) => new Vector3().setFromMatrixPosition(lamp.matrixWorld).normalize());
};

describe('lamps beside the dragged one', () => {
	it('are as many as asked for, of colours of their own, and all together not much brighter', () => {
		const lamps = new Lamps(1);
		expect([lamps.lit, lamps.share]).toEqual([1, 1]);
		for (let count = 1; count <= MAX_LAMPS; count++) {
			lamps.lit = count;
			expect(lamps.children).toHaveLength(count - 1);
			expect(lamps.lit).toBe(count);
			const others = lamps.children as DirectionalLight[];
			for (const lamp of others) expect(lamp).toBeInstanceOf(DirectionalLight);
			expect(new Set(others.map(({ color }) => color.getHex())).size).toBe(count - 1);
			const all = others.reduce((sum, { intensity }) => sum + intensity, lamps.share);
			expect(all).toBeLessThan(2.3);
			for (const { intensity } of others) expect(intensity).toBeLessThan(lamps.share);
		}
	});

	it('turn with it: all angles between them stay', () => {
		const lamps = new Lamps(1);
		lamps.lit = MAX_LAMPS;
		const angles = (key: Vector3) => {
			lamps.turn(key);
			const all = [key, ...directions(lamps)];
			return all.flatMap((a, i) => all.slice(i + 1).map((b) => a.angleTo(b)));
		};
		const before = angles(new Vector3(0, 1, 0));
		for (const key of [new Vector3(-0.8, 0.6, 0), new Vector3(0.1, -0.9, 0.4).normalize()])
			angles(key).forEach((angle, i) => {
				expect(angle).toBeCloseTo(before[i] ?? 0, 6);
			});
	});
});
