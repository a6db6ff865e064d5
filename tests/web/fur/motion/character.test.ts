/** Hairs of a body that moves by its joints. */

import {
	AnimationClip,
	AnimationMixer,
	type DataTexture,
	Euler,
	Float32BufferAttribute,
	Quaternion,
	QuaternionKeyframeTrack,
	Vector3,
} from 'three';
import { describe, expect, it } from 'vitest';
import { FurMotion } from '../../../../web/fur/motion/FurMotion.ts';
import { FurWeather } from '../../../../web/fur/weather/FurWeather.ts';
import { type Body, swingOf } from '../furs.ts';
import { apart, largest, reach, shake } from './ball.ts';
import { follicleAt, LENGTH, type Limb, limb, RADIUS, rootOf, skinned } from './limb.ts';

const FRAME = 1 / 60;
/** Frequency of the hairs, Hz. */
const PACE = 2.4;

/** Three numbers of a hair. */
const tip = (body: Body, i: number) => new Vector3().fromArray(swingOf(body), 3 * i);

/**
 * A hair by itself: x″ = −ω²(x − xₑ) − 2ζω·x′ − a, with the root's acceleration by differences of its places, felt 1/25 s
 * late, in a frame by differences of the skin's places.
 *
 * @param pose the limb's pose, seconds
 * @returns displacement at the rest's axes, shares of the length, at some seconds
 */
function alone(body: Limb, i: number, pose: (t: number) => void, seconds: number): Vector3 {
	const { at, normal } = rootOf(body, i);
	const along = new Vector3(1, 0, 0);
	const across = new Vector3().crossVectors(normal, along);
	const place = (t: number, towards = along, far = 0) => {
		pose(t);
		return skinned(body, at.clone().addScaledVector(towards, far));
	};
	const h = 1 / 2000;
	/** A vector of the world in the tangent plane, the rest's axes. */
	const level = (t: number, vector: Vector3) => {
		const edge = (towards: Vector3) => place(t, towards, 1e-4).sub(place(t)).normalize();
		const [u, v] = [edge(along), edge(across)];
		return along.clone().multiplyScalar(vector.dot(u)).addScaledVector(across, vector.dot(v));
	};
	const down = new Vector3(0, -1, 0);
	const laid = level(0, down);
	const [x, v, felt] = [new Vector3(), new Vector3(), new Vector3()];
	const pace = 2 * Math.PI * PACE;
	for (let t = 0; t < seconds; t += h) {
		const push = place(t + h)
			.add(place(t - h))
			.addScaledVector(place(t), -2)
			.divideScalar(h * h * LENGTH);
		felt.lerp(push, 1 - Math.exp(-h * 25));
		const sag = level(t, down).sub(laid).multiplyScalar(0.3);
		const force = sag
			.sub(x)
			.multiplyScalar(pace ** 2)
			.addScaledVector(v, -2 * 0.28 * pace)
			.sub(level(t, felt));
		v.addScaledVector(force, h);
		x.addScaledVector(v, h);
	}
	return x;
}

/** Moves a limb for some seconds. @returns where a tip is after each frame, and shown a thirtieth of a second late */
function moved(body: Limb, i: number, pose: (t: number) => void, seconds: number): Vector3[] {
	pose(0);
	const motion = new FurMotion(body.fur, { coupling: 0 });
	motion.update(FRAME);
	return Array.from({ length: Math.round(60 * seconds) }, (_, frame) => {
		pose((frame + 1) * FRAME);
		motion.update(FRAME);
		return tip(body, i);
	});
}

/** From 0 to 1 within some seconds, smoothly. */
const step = (t: number, seconds: number) => {
	const s = Math.min(Math.max(t / seconds, 0), 1);
	return s * s * (3 - 2 * s);
};

/** Largest distance of a path from what a hair does alone, share of its largest swing. */
function off(body: Limb, i: number, pose: (t: number) => void, path: Vector3[]): number {
	const swung = Math.max(...path.map((tip) => tip.length()));
	const frames = path.flatMap((tip, frame) => (frame % 6 === 5 ? [{ tip, t: (frame + 1) / 60 - 1 / 30 }] : []));
	return Math.max(...frames.map(({ tip, t }) => tip.distanceTo(alone(body, i, pose, t)))) / swung;
}

describe('hairs of a character', () => {
	it('move as on a body turned by its node where one joint turns all of it', () => {
		const [node, joint] = [limb(() => 0), limb(() => 0)];
		for (const [body, place] of [
			[node, node.place],
			[joint, joint.shoulder],
		] as const) {
			const motion = new FurMotion(body.fur, { seed: 3 });
			motion.wind.strength = 0.4;
			motion.wind.gusts = 1;
			for (let frame = 0; frame < 200; frame++) {
				shake({ ...body, place: place as unknown as Body['place'] }, frame / 60);
				motion.update(FRAME);
			}
			expect(largest(swingOf(body))).toBeGreaterThan(0.2);
		}
		expect(apart(swingOf(node), swingOf(joint))).toBeLessThan(1e-4);
	});

	it.each([
		['beyond the elbow', 1.8],
		['at the elbow', 1],
	])('lag behind a step and swing through, %s', (_, x) => {
		const body = limb();
		const i = follicleAt(body, new Vector3(x, 0, RADIUS));
		const pose = (t: number) => body.shoulder.position.set(0.06 * step(t, 0.2), 0, 0);
		const path = moved(body, i, pose, 0.8);
		expect(Math.min(...path.slice(0, 12).map(({ x }) => x))).toBeLessThan(-0.03);
		expect(Math.max(...path.map(({ x }) => x))).toBeGreaterThan(0.03);
		// They feel a fast body less: it moves at up to 1.5 of their lengths in a second here.
		expect(off(body, i, pose, path)).toBeLessThan(0.15);
	});

	it('swing out in a turn of the elbow by ω²r/ω₀²', () => {
		const body = limb();
		const i = follicleAt(body, new Vector3(2, 0, RADIUS));
		const rate = 0.4;
		const pose = (t: number) => body.elbow.rotation.set(0, rate * (t < 0.3 ? (t * t) / 0.6 : t - 0.15), 0);
		const path = moved(body, i, pose, 1.5);
		const out = rate ** 2 / (2 * Math.PI * PACE) ** 2 / LENGTH;
		const tail = path.slice(60).map(({ x }) => x / out);
		expect(Math.min(...tail)).toBeGreaterThan(0.85);
		expect(Math.max(...tail)).toBeLessThan(1.02);
		expect(off(body, i, pose, path)).toBeLessThan(0.15);
	});

	it.each([
		['on the forearm', 1.7],
		['at the elbow', 0.9],
	])('hang from a forearm that is raised, %s', (_, x) => {
		const body = limb();
		const i = follicleAt(body, new Vector3(x, 0, RADIUS));
		const pose = (t: number) => body.elbow.rotation.set(0, 0, 1.2 * step(t, 0.8));
		const path = moved(body, i, pose, 1.5);
		// Back along the arm, which points up.
		expect((path.at(-1) as Vector3).x).toBeLessThan(-0.1);
		expect(off(body, i, pose, path)).toBeLessThan(0.1);
	});

	/** A clip in which the elbow bends to and fro within a second. */
	function clip({ place, elbow }: Limb): AnimationMixer {
		elbow.name = 'elbow';
		const turns = [0, 2, 0].flatMap((angle) => new Quaternion().setFromEuler(new Euler(0, angle, 0)).toArray());
		const track = new QuaternionKeyframeTrack('elbow.quaternion', [0, 0.5, 1], turns);
		const mixer = new AnimationMixer(place);
		mixer.clipAction(new AnimationClip('wave', 1, [track])).play();
		return mixer;
	}

	it('are awake as long as a clip plays, and fall asleep when it is paused', () => {
		const body = limb();
		const mixer = clip(body);
		const motion = new FurMotion(body.fur);
		for (let frame = 0; frame < 300; frame++) {
			mixer.update(FRAME);
			if (frame > 0) expect(motion.update(FRAME)).toBe(true);
			else motion.update(FRAME);
		}
		expect(largest(swingOf(body))).toBeGreaterThan(0.05);
		mixer.timeScale = 0;
		let frames = 0;
		for (; frames < 300 && motion.update(FRAME); frames++) mixer.update(FRAME);
		expect(frames).toBeLessThan(240);
		expect([motion.asleep, motion.update(FRAME)]).toEqual([true, false]);
	});

	it('are not flung by a body that is set elsewhere, nor by joints that collapse', () => {
		const body = limb();
		const motion = new FurMotion(body.fur);
		motion.update(FRAME);
		for (let frame = 0; frame < 60; frame++) {
			if (frame === 10) body.place.position.set(30, 20, -400);
			if (frame === 20) body.shoulder.position.set(0, 7, 0);
			if (frame === 30) body.elbow.scale.setScalar(0);
			if (frame === 40) body.elbow.scale.setScalar(Number.NaN);
			if (frame === 50) body.elbow.scale.setScalar(1);
			motion.update(FRAME);
			expect(largest(swingOf(body)), `${frame}`).toBeLessThan(1e-6);
		}
	});

	it('do nothing where no joint carries them', () => {
		const body = limb(() => Number.NaN);
		const motion = new FurMotion(body.fur);
		motion.wind.strength = 1;
		for (let frame = 0; frame < 30; frame++) {
			body.shoulder.rotation.y += 0.1;
			motion.update(FRAME);
		}
		expect(largest(swingOf(body))).toBe(0);
	});

	it('stay within their limit when another pose comes at once, and hang as that pose lets them soon after', () => {
		const [body, still] = [limb(), limb()];
		const [motion, settled] = [new FurMotion(body.fur), new FurMotion(still.fur)];
		for (let frame = 0; frame < 300; frame++) {
			if (frame === 10) body.elbow.rotation.z = 2;
			motion.update(FRAME);
			expect(reach(body)).toBeLessThanOrEqual(0.8 + 1e-6);
			expect(swingOf(body).every(Number.isFinite)).toBe(true);
		}
		still.elbow.rotation.z = 2;
		settled.settle();
		expect(largest(swingOf(still))).toBeGreaterThan(0.1);
		expect(apart(swingOf(body), swingOf(still))).toBeLessThan(2e-3);
	});

	it('lag behind a morph target as behind a body that its node moves as far', () => {
		const [node, target] = [limb(), limb()];
		const { geometry } = target.mesh;
		const way = new Float32Array(3 * geometry.getAttribute('position').count);
		way.forEach((_, i) => {
			if (i % 3 === 0) way[i] = 0.5 / target.mesh.scale.x;
		});
		geometry.morphAttributes.position = [new Float32BufferAttribute(way, 3)];
		const influences = [0];
		Object.assign(target.fur, { ground: { skin: { pose: { influences } } } });
		const motions = [new FurMotion(node.fur), new FurMotion(target.fur)];
		let swung = 0;
		for (let frame = 0; frame < 120; frame++) {
			node.place.position.x = 0.5 * step(frame / 60, 0.6);
			influences[0] = step(frame / 60, 0.6);
			for (const motion of motions) motion.update(FRAME);
			swung = Math.max(swung, largest(swingOf(target)));
			expect(apart(swingOf(node), swingOf(target))).toBeLessThan(1e-3);
		}
		expect(swung).toBeGreaterThan(0.05);
		for (const motion of motions) {
			let frames = 0;
			while (motion.update(FRAME)) expect(frames++).toBeLessThan(240);
		}
	});

	it('lie in a lane where a finger goes over the arm at rest', () => {
		const body = limb();
		const motion = new FurMotion(body.fur);
		const hair = (x: number) => follicleAt(body, new Vector3(x, 0, RADIUS));
		body.elbow.rotation.y = 1;
		motion.update(FRAME);
		motion.stroke(new Vector3(1.5, 0, RADIUS), new Vector3(1.8, 0, RADIUS), 0.15);
		for (let frame = 0; frame < 12; frame++) motion.update(FRAME);
		expect(tip(body, hair(1.6)).x).toBeGreaterThan(0.4);
		expect(tip(body, hair(0.4)).length()).toBeLessThan(0.05);
	});
});

describe('weather on a character', () => {
	it('stays where it was painted', () => {
		const body = limb();
		const weather = new FurWeather(Object.assign(body.fur, { weather: undefined }));
		const place = new Vector3(1.8, 0, RADIUS);
		weather.mud(place, 0.2, 1);
		weather.update(FRAME);
		const painted = () => [...((weather.stains as DataTexture).image.data as Uint8Array)];
		const before = painted();
		const dirt = (x: number) => before[2 * follicleAt(body, new Vector3(x, 0, RADIUS)) + 1];
		expect([dirt(1.8), dirt(0.2), dirt(1)]).toEqual([240, 0, 0]);
		const motion = new FurMotion(body.fur);
		for (let frame = 0; frame < 30; frame++) {
			body.elbow.rotation.y += 0.05;
			motion.update(FRAME);
			weather.update(FRAME);
		}
		expect(painted()).toEqual(before);
	});
});
