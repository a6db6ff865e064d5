import { BufferGeometry, Float32BufferAttribute, SphereGeometry, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { FurMotion } from '../../../../web/fur/motion/FurMotion.ts';
import type { FurMotionOptions } from '../../../../web/fur/motion/options.ts';
import { type Body, bodyOf, swingOf } from '../furs.ts';

/** A ball of long fur, or a lawn of hairs that point up. */
const ball = () => bodyOf(new SphereGeometry(1, 24, 16), 0.1);

function lawn(): Body {
	const side = 21;
	const places = Array.from({ length: side * side }, (_, i) => [(i % side) / 10 - 1, 0, Math.floor(i / side) / 10 - 1]);
	const corner = (x: number, z: number) => z * side + x;
	const faces = places.flatMap((_, i) => {
		const [x, z] = [i % side, Math.floor(i / side)];
		if (x === side - 1 || z === side - 1) return [];
		return [corner(x, z), corner(x, z + 1), corner(x + 1, z), corner(x + 1, z), corner(x, z + 1), corner(x + 1, z + 1)];
	});
	const geometry = new BufferGeometry()
		.setAttribute('position', new Float32BufferAttribute(places.flat(), 3))
		.setAttribute(
			'normal',
			new Float32BufferAttribute(
				places.flatMap(() => [0, 1, 0]),
				3,
			),
		)
		.setIndex(faces);
	return bodyOf(geometry, 0.1);
}

const tips = (body: Body) => {
	const swing = swingOf(body);
	return Array.from({ length: swing.length / 3 }, (_, i) => new Vector3().fromArray(swing, 3 * i));
};
const middle = (body: Body) => tips(body)[220] as Vector3;
const normals = ({ fur }: Body) =>
	Array.from({ length: fur.follicles.count }, (_, i) => new Vector3().fromArray(fur.follicles.normal, 3 * i));

function blown(
	body: Body,
	strength: number,
	direction: [number, number, number],
	gusts = 0,
	options: FurMotionOptions = {},
): FurMotion {
	const motion = new FurMotion(body.fur, options);
	motion.wind.strength = strength;
	motion.wind.gusts = gusts;
	motion.wind.direction.set(...direction);
	return motion;
}

describe('the wind', () => {
	it('lays the fur of a lawn to 0.7 where it is a storm, and by its share where it is less', () => {
		const body = lawn();
		const motion = blown(body, 1, [3, 0, 0]);
		motion.settle();
		const storm = middle(body);
		expect(storm.length()).toBeGreaterThan(0.55);
		expect(storm.length()).toBeLessThan(0.75);
		expect(storm.x / storm.length()).toBeCloseTo(1, 5);
		motion.wind.strength = 0.25;
		motion.settle();
		expect(middle(body).x).toBeCloseTo(storm.x / 4, 3);
	});

	it('is stronger to windward than in the lee, and blows along the skin', () => {
		const body = ball();
		blown(body, 0.6, [1, 0, 0]).settle();
		const [blownTips, normal] = [tips(body), normals(body)];
		const mean = (from: number, to: number) => {
			const lengths = blownTips.flatMap((x, i) => {
				const across = (normal[i] as Vector3).x;
				return across > from && across < to ? [x.length()] : [];
			});
			return lengths.reduce((sum, length) => sum + length, 0) / lengths.length;
		};
		expect(mean(-0.8, -0.5)).toBeGreaterThan(1.5 * mean(0.5, 0.8));
		for (const [i, x] of blownTips.entries()) {
			expect(Math.abs(x.dot(normal[i] as Vector3))).toBeLessThan(1e-5);
			expect(x.x).toBeGreaterThan(-1e-3);
		}
	});

	it('blows in the world, whatever the body under it is turned to', () => {
		const [still, turned] = [ball(), ball()];
		// Onto itself: the ball has 24 meridians.
		turned.place.rotation.y = (5 / 24) * 2 * Math.PI;
		for (const body of [still, turned]) {
			// Each hair by itself: where the ball's meridians begin its vertices are not quite the same.
			const motion = blown(body, 0.7, [1, 0.2, 0.5], 1, { coupling: 0 });
			for (let i = 0; i < 100; i++) motion.update(1 / 60);
		}
		const [before, after] = [tips(still), tips(turned)];
		const normal = normals(still);
		for (const [i, outward] of normals(turned).entries()) {
			const world = outward.transformDirection(turned.place.matrixWorld);
			const same = normal.findIndex((other) => other.distanceTo(world) < 1e-4);
			const moved = (after[i] as Vector3).applyEuler(turned.place.rotation);
			expect(moved.distanceTo(before[same] as Vector3)).toBeLessThan(1e-4);
		}
		expect(Math.max(...before.map((x) => x.length()))).toBeGreaterThan(0.3);
	});

	it('is the same for a seed, and another one for another', () => {
		const [a, b, c] = [3, 3, 4].map((seed) => {
			const body = lawn();
			const motion = blown(body, 0.5, [1, 0, 0], 1, { seed });
			for (let i = 0; i < 100; i++) motion.update(1 / 60);
			return swingOf(body);
		});
		expect(b).toEqual(a);
		expect(c).not.toEqual(a);
	});

	it('comes in gusts that run over the fur with it', () => {
		const body = lawn();
		const motion = blown(body, 0.5, [1, 0, 0], 1);
		// How far the tips lie along the middle row, frame by frame.
		const frames = Array.from({ length: 240 }, () => {
			motion.update(1 / 60);
			const swing = swingOf(body);
			return Array.from({ length: 21 }, (_, x) => swing[3 * (210 + x)] as number);
		}).slice(60);
		const mean = (values: number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;
		const alike = (lag: number) => {
			const pairs = frames.slice(lag).map((row, i) => [row[16] as number, frames[i]?.[6] as number] as const);
			const [m, n] = [mean(pairs.map(([p]) => p)), mean(pairs.map(([, q]) => q))];
			const part = (f: (p: number, q: number) => number) => mean(pairs.map(([p, q]) => f(p - m, q - n)));
			return part((p, q) => p * q) / Math.sqrt(part((p) => p * p) * part((_, q) => q * q));
		};
		// One unit downwind the same comes some tenths of a second later, and not earlier.
		const lags = Array.from({ length: 80 }, (_, lag) => alike(lag));
		const best = lags.indexOf(Math.max(...lags));
		expect(best).toBeGreaterThan(15);
		expect(best).toBeLessThan(80);
		expect(lags[best]).toBeGreaterThan(0.6);
		const row = frames.map((row) => row[10] as number);
		expect(Math.max(...row) - Math.min(...row)).toBeGreaterThan(0.2);
		// Never against the wind for long, and not in step everywhere.
		expect(mean(row)).toBeGreaterThan(0.15);
		expect(Math.max(...frames.map((row) => Math.max(...row) - Math.min(...row)))).toBeGreaterThan(0.2);
	});

	it('is none without a direction or a strength', () => {
		for (const [strength, direction] of [
			[1, [0, 0, 0]],
			[0, [1, 0, 0]],
			[Number.NaN, [1, 0, 0]],
			[-1, [1, 0, 0]],
		] as [number, [number, number, number]][]) {
			const body = lawn();
			const motion = blown(body, strength, direction, 1);
			expect([motion.update(1 / 60), motion.update(1 / 60), motion.swing]).toEqual([false, false, undefined]);
		}
	});

	it('lets the fur come back when it drops, and is awake as long as gusts blow', () => {
		const body = lawn();
		const motion = blown(body, 0.6, [0, 1, 0], 1);
		for (let i = 0; i < 300; i++) expect(motion.update(1 / 60)).toBe(true);
		motion.wind.direction.set(1, 0, 0);
		for (let i = 0; i < 60; i++) motion.update(1 / 60);
		expect(middle(body).length()).toBeGreaterThan(0.1);
		motion.wind.strength = 0;
		let frames = 0;
		while (motion.update(1 / 60)) frames++;
		expect(frames).toBeLessThan(240);
		expect(motion.swing).toBeUndefined();
	});
});
