import { describe, expect, it } from 'vitest';
import { SharedLight } from '../../../web/learn/light.ts';

describe('the light of the lesson', () => {
	it('drifts until somebody takes it, and tells all who listen', () => {
		const light = new SharedLight([0, 1, 1], { on: false }, () => {});
		const heard: number[][] = [];
		const stop = light.listen(({ x, y, z }) => heard.push([x, y, z]));
		expect(heard).toHaveLength(1);
		expect(light.step(0.1)).toBe(true);
		expect(heard).toHaveLength(2);
		light.set(1, 1, 0);
		expect(light.drifting).toBe(false);
		for (let i = 0; i < 100; i++) light.step(0.1);
		expect(light.direction.x).toBeCloseTo(Math.SQRT1_2, 6);
		expect(light.step(0.1)).toBe(false);
		stop();
		const before = heard.length;
		light.set(0, 1, 0);
		light.step(0.1);
		expect(heard).toHaveLength(before);
	});

	it('never sinks below the horizon of the patch', () => {
		const light = new SharedLight([0, 1, 1], { on: true }, () => {});
		for (const [x, y, z] of [
			[1, -1, 0],
			[0, -1, 0],
			[0.3, 0, 0.4],
		] as const) {
			light.set(x, y, z);
			light.step(0);
			expect(light.direction.y).toBeCloseTo(Math.sin((4 * Math.PI) / 180), 6);
			expect(light.direction.length()).toBeCloseTo(1, 6);
		}
		light.turn(0, -3);
		light.step(0);
		expect(light.direction.y).toBeGreaterThan(0);
	});

	it('stays where it is where calm is asked for, and jumps where it is wanted', () => {
		const light = new SharedLight([0, 1, 1], { on: true }, () => {});
		expect(light.step(10)).toBe(false);
		light.set(-1, 1, 0);
		light.step(0);
		expect(light.direction.x).toBeCloseTo(-Math.SQRT1_2, 6);
	});

	it('is held while it drifts, and drifts on from there', () => {
		const calm = { on: false };
		const light = new SharedLight([0, 1, 1], calm, () => {});
		light.step(0.5);
		const { x } = light.direction;
		calm.on = true;
		expect(light.step(5)).toBe(false);
		expect(light.direction.x).toBe(x);
		calm.on = false;
		expect(light.step(0.1)).toBe(true);
		expect(light.direction.x).not.toBe(x);
		expect(light.direction.x).toBeCloseTo(x, 1);
	});
});
