import { describe, expect, it } from 'vitest';
import { FurMotion } from '../../../../web/fur/motion/FurMotion.ts';
import { type Body, load, swingOf } from '../furs.ts';
import { apart, ball, finger, largest, reach, shake } from './ball.ts';

describe('FurMotion', () => {
	/** Frames until nothing moves. @returns seconds */
	function untilAsleep(motion: FurMotion): number {
		let frames = 0;
		while (motion.update(1 / 60)) if (++frames > 6000) throw new Error('awake after 100 s');
		return frames / 60;
	}

	it.each([1 / 240, 1 / 60, 0.1, 0.25, 0.5])(
		'stays within its limits in a storm, shaken and stroked, at %f s',
		(dt) => {
			const body = ball();
			const motion = new FurMotion(body.fur, { frequency: 3.7, damping: 0.06, coupling: 1 });
			motion.wind.strength = motion.wind.gusts = 1;
			let widest = 0;
			for (let t = dt; t < Math.max(4, 20 * dt); t += dt) {
				shake(body, 2 * t);
				// Now and then it is somewhere else, and turned about.
				if (Math.floor(t) % 2 === 0) body.place.position.x += 50;
				motion.wind.direction.set(Math.cos(9 * t), Math.sin(5 * t), Math.sin(9 * t));
				motion.gravity = Math.floor(3 * t) % 2 === 0 ? -5 : 5;
				motion.stroke(finger(t % 1), finger((t % 1) + dt), 0.5);
				expect(motion.update(dt)).toBe(true);
				widest = Math.max(widest, reach(body));
				expect(swingOf(body).every(Number.isFinite)).toBe(true);
			}
			expect(widest).toBeGreaterThan(0.7);
			expect(widest).toBeLessThanOrEqual(0.8 + 1e-6);
		},
	);

	it('is asleep as the fur was baked, whatever it is turned to about the vertical', () => {
		const body = ball();
		const motion = new FurMotion(body.fur);
		body.place.rotation.y = 1.234;
		body.place.scale.setScalar(0.37);
		expect([motion.asleep, motion.swing, motion.update(1 / 60), motion.update(9)]).toEqual([
			true,
			undefined,
			false,
			false,
		]);
		expect(body.fur.swing).toBeUndefined();
	});

	it('stirs when it is carried, and is as it was baked to 1e-3 and asleep soon after', () => {
		const body = ball();
		const motion = new FurMotion(body.fur);
		motion.update(1 / 60);
		let widest = 0;
		for (let i = 0; i < 30; i++) {
			body.place.position.x += 0.01;
			expect(motion.update(1 / 60)).toBe(true);
			widest = Math.max(widest, largest(swingOf(body)));
		}
		expect(widest).toBeGreaterThan(0.1);
		let last = 1;
		let seconds = 0;
		while (motion.update(1 / 60)) {
			seconds += 1 / 60;
			if (motion.swing) last = largest(swingOf(body));
		}
		expect(last).toBeLessThan(1e-3);
		expect(seconds).toBeLessThan(4);
		expect([motion.asleep, motion.swing, body.fur.swing]).toEqual([true, undefined, undefined]);
	});

	it('lags behind a body that starts, and swings through when it stops', () => {
		const body = ball();
		const motion = new FurMotion(body.fur);
		motion.update(1 / 60);
		const front = body.fur.follicles.position.reduce(
			(best, z, i, all) => (i % 3 === 2 && z > (all[3 * best + 2] as number) ? (i - 2) / 3 : best),
			0,
		);
		const move = (frames: number, step: number) => {
			const sides: number[] = [];
			for (let i = 0; i < frames; i++) {
				body.place.position.x += step;
				motion.update(1 / 60);
				sides.push(swingOf(body)[3 * front] as number);
			}
			return sides;
		};
		expect(Math.min(...move(12, 0.01))).toBeLessThan(-0.1);
		move(120, 0.01);
		expect(Math.max(...move(12, 0))).toBeGreaterThan(0.1);
	});

	it('takes a placement elsewhere for none of its motion', () => {
		const body = ball();
		const motion = new FurMotion(body.fur);
		motion.update(1 / 60);
		body.place.position.set(30, 20, -400);
		motion.update(1 / 60);
		for (let i = 0; i < 20; i++) motion.update(1 / 60);
		expect(largest(swingOf(body))).toBe(0);
		body.place.scale.setScalar(0);
		motion.update(1 / 60);
		body.place.scale.setScalar(Number.NaN);
		motion.update(1 / 60);
		body.place.scale.setScalar(1);
		for (let i = 0; i < 20; i++) motion.update(1 / 60);
		expect(largest(swingOf(body))).toBe(0);
	});

	it('hangs down from a body that lies on its side, and sleeps like that', () => {
		const body = ball();
		const motion = new FurMotion(body.fur);
		body.place.rotation.z = Math.PI / 2;
		motion.update(1 / 60);
		untilAsleep(motion);
		expect(motion.swing).toBeDefined();
		// The world's down is the ball's −x; what it was baked with, −y.
		const { follicles } = body.fur;
		const swing = swingOf(body);
		let towards = 0;
		for (let i = 0; i < follicles.count; i++) towards += (swing[3 * i + 1] as number) - (swing[3 * i] as number);
		expect(towards / follicles.count).toBeGreaterThan(0.1);
		body.place.rotation.z = 0;
		motion.update(1 / 60);
		untilAsleep(motion);
		expect(motion.swing).toBeUndefined();
	});

	it('settles at once where it goes by itself', () => {
		const [slow, quick] = [ball(), ball()].map((body) => {
			const motion = new FurMotion(body.fur, { gravity: 0.3 });
			body.place.rotation.x = 1;
			motion.wind.strength = 0.4;
			motion.wind.gusts = 0;
			return { body, motion };
		}) as [{ body: Body; motion: FurMotion }, { body: Body; motion: FurMotion }];
		slow.motion.update(1 / 60);
		untilAsleep(slow.motion);
		quick.motion.settle();
		expect([quick.motion.asleep, quick.motion.update(1 / 60)]).toEqual([true, false]);
		expect(largest(swingOf(quick.body))).toBeGreaterThan(0.1);
		expect(apart(swingOf(slow.body), swingOf(quick.body))).toBeLessThan(2e-3);
		quick.motion.reset();
		expect([quick.motion.swing, quick.body.fur.swing, quick.motion.asleep]).toEqual([undefined, undefined, true]);
		expect(quick.motion.update(1 / 60)).toBe(true);
	});

	it('leaves a lane under a finger, there alone, which recovers', () => {
		const body = ball();
		const motion = new FurMotion(body.fur);
		const { position, comb, count } = body.fur.follicles;
		for (let t = 0.3; t < 0.7; t += 1 / 60) {
			motion.stroke(finger(t), finger(t + 1 / 60), 0.4);
			motion.update(1 / 60);
		}
		const lane = () => {
			const swing = swingOf(body);
			let [inside, outside] = [0, 0];
			for (let i = 0; i < count; i++) {
				const [x, y, z] = [position[3 * i], position[3 * i + 1], position[3 * i + 2]] as [number, number, number];
				if (z > 0.6 && Math.abs(y - 0.1) < 0.2)
					inside = Math.max(inside, (swing[3 * i] as number) + (comb[3 * i] as number));
				if (z < -0.3 || Math.abs(y) > 0.9) outside = Math.max(outside, Math.abs(swing[3 * i] as number));
				expect(x).toBeDefined();
			}
			return { inside, outside };
		};
		expect(lane().inside).toBeGreaterThan(0.7);
		expect(lane().outside).toBeLessThan(0.02);
		const after = (seconds: number) => {
			for (let i = 0; i < seconds * 60; i++) motion.update(1 / 60);
			return lane().inside;
		};
		expect(after(2)).toBeGreaterThan(0.12);
		expect(after(3)).toBeLessThan(0.08);
		let last = 1;
		let seconds = 0;
		while (motion.update(1 / 60)) {
			seconds += 1 / 60;
			if (motion.swing) last = largest(swingOf(body));
		}
		expect(seconds).toBeLessThan(4);
		// No leap when it falls asleep.
		expect(last).toBeLessThan(2e-3);
		expect(motion.swing).toBeUndefined();
	});

	it('does no more than half a second of work for a hidden tab, and goes on from there', () => {
		const [hidden, half] = [ball(), ball()].map((body) => {
			const motion = new FurMotion(body.fur);
			motion.wind.strength = 0.5;
			for (let i = 0; i < 60; i++) motion.update(1 / 60);
			return { body, motion };
		}) as [{ body: Body; motion: FurMotion }, { body: Body; motion: FurMotion }];
		hidden.motion.update(3600);
		half.motion.update(0.5);
		expect(apart(swingOf(hidden.body), swingOf(half.body))).toBe(0);
	});

	it('takes no time for a frame of none', () => {
		const body = ball();
		const motion = new FurMotion(body.fur);
		motion.wind.strength = 1;
		for (const seconds of [0, -1, Number.NaN]) motion.update(seconds);
		expect(motion.swing).toBeUndefined();
		motion.update(1 / 60);
		expect(motion.update(0)).toBe(true);
	});

	it('stays on the CPU where there is no GPU, whatever that costs', () => {
		let now = 0;
		const motion = new FurMotion(ball().fur, { clock: () => (now += 50) });
		motion.wind.strength = 1;
		for (let i = 0; i < 100; i++) motion.update(1 / 60);
		expect(motion.processor).toBe('cpu');
	});

	it.each([
		['frequency', 0, 'got 0, expected 0.2 to 20'],
		['damping', 1, 'got 1, expected 0.05 to 0.95'],
		['coupling', -1, 'got -1, expected 0 to 1'],
		['relaxation', Number.NaN, 'got NaN, expected 0.01 to 3600'],
	])('does not take every %s', (name, value, words) => {
		expect(() => new FurMotion(ball().fur, { [name]: value })).toThrow(`FurMotion/${name}: ${words}`);
	});

	it('leaves a real body as it was', () => {
		const body = load('torus-512');
		const motion = new FurMotion(body.fur);
		motion.wind.strength = 0.8;
		for (let i = 0; i < 60; i++) motion.update(1 / 60);
		expect(largest(swingOf(body))).toBeGreaterThan(0.2);
		// What is dressed on it learns by its texture that it is over.
		let over = false;
		motion.swing?.addEventListener('dispose', () => {
			over = true;
		});
		motion.dispose();
		expect([body.fur.swing, over]).toEqual([undefined, true]);
	});
});
