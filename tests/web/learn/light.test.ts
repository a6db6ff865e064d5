import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { MovingLight, turned } from '../../../web/page/light.ts';

describe('turned', () => {
	it('moves to the right and up, and stops at the poles', () => {
		const right = turned(new Vector3(0, 0, 1), Math.PI / 2, 0);
		expect(right.distanceTo(new Vector3(1, 0, 0))).toBeLessThan(1e-12);
		const up = turned(new Vector3(0, 0, 1), 0, Math.PI / 6);
		expect(up.y).toBeCloseTo(0.5, 12);
		expect(turned(new Vector3(0, 0, 1), 0, 99).y).toBeLessThan(1);
		expect(turned(new Vector3(0, 0, 1), 0, 99).z).toBeGreaterThan(0);
	});
});

describe('a moving light', () => {
	it('drifts by itself, a unit vector, until it is wanted somewhere', () => {
		const light = new MovingLight(true);
		light.put([0, 3, 4], true);
		expect(light.drifting).toBe(true);
		for (let i = 0; i < 100; i++) expect(light.step(0.3)).toBe(true);
		expect(light.direction.length()).toBeCloseTo(1, 9);
		light.want((wanted) => turned(wanted, 0.5, 0));
		expect(light.drifting).toBe(false);
		for (let i = 0; i < 100 && light.step(0.05); i++);
		expect(light.step(1)).toBe(false);
		expect(light.direction.toArray()).toEqual(light.wanted);
	});

	it('glides the same way at any frame rate', () => {
		const ends = [1, 4].map((parts) => {
			const light = new MovingLight(true);
			light.put([0, 0, 1], false);
			light.want((wanted) => wanted.set(1, 0, 0));
			for (let i = 0; i < parts; i++) light.step(0.06 / parts);
			return light.direction.clone();
		});
		expect(ends[0]?.angleTo(ends[1] ?? new Vector3())).toBeLessThan(1e-6);
	});

	it('finds its way to the straight opposite', () => {
		for (const from of [new Vector3(0, 0, 1), new Vector3(0, 1, 0), new Vector3(1, 0, 0)]) {
			const light = new MovingLight(true);
			light.put(from.toArray(), false);
			light.want((wanted) => wanted.negate());
			for (let i = 0; i < 200; i++) light.step(0.02);
			expect(light.direction.distanceTo(from.clone().negate())).toBeLessThan(1e-9);
		}
	});

	it('jumps and never drifts where nothing may move by itself', () => {
		const light = new MovingLight(false);
		light.put([0, 0, 1], true);
		expect(light.drifting).toBe(false);
		expect(light.step(10)).toBe(false);
		light.want((wanted) => wanted.set(0, 1, 0));
		light.step(0);
		expect(light.direction.toArray()).toEqual([0, 1, 0]);
	});
});
