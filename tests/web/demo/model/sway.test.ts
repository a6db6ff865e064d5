import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { Sway } from '../../../../web/demo/model/sway.ts';

const aside = new Vector3(0.2, 0, 0);

function run(sway: Sway, seconds: number, rate: number): number[] {
	return Array.from({ length: Math.round(seconds * rate) }, () => {
		sway.step(1 / rate);
		return sway.offset.x;
	});
}

describe('a body', () => {
	it('goes the same way at any frame rate', () => {
		const ends = [5, 30, 145, 1000].map((rate) => {
			const sway = new Sway();
			sway.pull(aside);
			run(sway, 0.4, rate);
			sway.release();
			run(sway, 0.6, rate);
			return sway.offset.x;
		});
		for (const end of ends) expect(end).toBeCloseTo(ends[0] as number, 9);
	});

	it('comes to the hand, swings past its place once that one can see, and rests there', () => {
		const sway = new Sway();
		sway.pull(aside);
		expect(run(sway, 4, 60).at(-1)).toBeCloseTo(0.6 * Math.tanh(0.2 / 0.6), 4);
		expect(sway.step(1)).toBe(false);
		sway.release();
		const path = run(sway, 4, 60);
		const past = -Math.min(...path);
		expect(past).toBeGreaterThan(0.03);
		expect(past).toBeLessThan(0.07);
		// Back again: hardly seen.
		expect(Math.max(...path.slice(path.indexOf(-past)))).toBeLessThan(0.015);
		expect(path.at(-1)).toBe(0);
		expect(sway.step(1 / 60)).toBe(false);
	});

	it('is bounded however far it is drawn and however long a step is, and does not sink', () => {
		const sway = new Sway();
		sway.pull(new Vector3(1e6, -1e6, 0));
		for (let i = 0; i < 50; i++) {
			sway.step(0.01 * 1.3 ** i);
			expect(sway.offset.length()).toBeLessThan(1);
		}
		sway.pull(new Vector3(0, -0.5, 0));
		run(sway, 3, 60);
		expect(sway.offset.y).toBeGreaterThan(-0.15);
	});

	it('swings when pushed, and not after it was put back', () => {
		const sway = new Sway();
		sway.push(new Vector3(1, 0, 0));
		expect(Math.max(...run(sway, 1, 60))).toBeGreaterThan(0.05);
		sway.reset();
		expect(sway.step(0.1)).toBe(false);
		expect(sway.offset.length()).toBe(0);
	});

	it('turns as a table does, and comes back the shorter way', () => {
		const sway = new Sway();
		sway.turning = true;
		run(sway, 23, 60);
		expect(sway.yaw).toBeCloseTo((23 / 24) * 2 * Math.PI, 6);
		sway.turning = false;
		expect(sway.yaw).toBeCloseTo((-2 * Math.PI) / 24, 6);
		run(sway, 6, 60);
		expect(sway.yaw).toBe(0);
		expect(sway.step(1)).toBe(false);
	});
});
