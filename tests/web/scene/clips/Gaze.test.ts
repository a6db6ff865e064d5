/** A head that looks at a light, on top of what a clip does with it. */

import { Bone, Group, Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { Gaze } from '../../../../web/scene/clips/Gaze.ts';

const DEGREE = Math.PI / 180;

/** A body whose neck faces +x, its head +z, on a root that is turned as the test says. */
function body(turned = 0) {
	const object = new Group();
	const [root, neck, head] = [new Bone(), new Bone(), new Bone()];
	object.add(root.add(neck.add(head)));
	root.rotation.y = turned;
	neck.rotation.y = Math.PI / 2;
	head.rotation.y = -Math.PI / 2;
	head.name = 'head';
	head.position.set(0, 1, 0);
	const gaze = Gaze.of(object) as Gaze;
	const frame = (seconds: number, clip: () => void = () => {}) => {
		gaze.lift();
		clip();
		gaze.apply(seconds);
		object.updateMatrixWorld(true);
	};
	/** Where the head looks: degrees to its left, and up. */
	const look = () => {
		const way = new Vector3(0, 0, 1).applyQuaternion(head.getWorldQuaternion(new Quaternion()));
		return [Math.atan2(way.x, way.z) / DEGREE, Math.asin(way.y) / DEGREE] as const;
	};
	return { object, root, neck, head, gaze, frame, look };
}

const towards = (aside: number, up: number) =>
	new Vector3(
		Math.sin(aside * DEGREE) * Math.cos(up * DEGREE),
		Math.sin(up * DEGREE),
		Math.cos(aside * DEGREE) * Math.cos(up * DEGREE),
	);

describe('the gaze', () => {
	it('arrives at a light before it, without a jump, and then rests', () => {
		const { gaze, frame, look } = body();
		expect(gaze.moves).toBe(false);
		gaze.aim(towards(10, 5));
		expect(gaze.moves).toBe(true);
		let [before] = look();
		for (let i = 0; i < 120; i++) {
			frame(1 / 60);
			expect(Math.abs(look()[0] - before)).toBeLessThan(0.6);
			[before] = look();
		}
		expect(look()[0]).toBeGreaterThan(9);
		expect(look()[0]).toBeLessThan(10.1);
		expect(look()[1]).toBeGreaterThan(4);
		for (let i = 0; i < 120; i++) frame(1 / 60);
		expect(gaze.moves).toBe(false);
	});

	it.each([
		[80, 60],
		[-80, -60],
		[100, 0],
	])('keeps within its limits for a light at %d, %d degrees', (aside, up) => {
		const { gaze, frame, look } = body();
		gaze.aim(towards(aside, up));
		frame(30);
		expect(Math.abs(look()[0])).toBeGreaterThan(25);
		expect(Math.abs(look()[0])).toBeLessThan(38.01);
		expect(Math.abs(look()[1])).toBeLessThan(18.01);
		expect(Math.sign(look()[0])).toBe(Math.sign(aside));
	});

	it('does not turn to what is behind', () => {
		const { gaze, frame, look } = body();
		gaze.aim(towards(175, 0));
		frame(30);
		expect(look()[0]).toBeCloseTo(0, 3);
	});

	it('is seen from the body, however that is turned', () => {
		const { gaze, frame, look } = body(50 * DEGREE);
		gaze.aim(towards(50, 0));
		frame(30);
		expect(look()[0]).toBeCloseTo(50, 3);
	});

	it('lies on top of the clip, adds up to nothing, and goes without a trace', () => {
		const { gaze, frame, look, head, neck } = body();
		const [rest, still] = [head.quaternion.clone(), neck.quaternion.clone()];
		const nod = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), 0.1);
		const clip = () => head.quaternion.copy(rest).multiply(nod);
		gaze.aim(towards(20, 0));
		for (let i = 0; i < 300; i++) frame(1 / 30, clip);
		const [aside] = look();
		expect(aside).toBeGreaterThan(15);
		expect(look()[1]).toBeCloseTo(-0.1 / DEGREE, 0);
		gaze.aim(undefined);
		for (let i = 0; i < 300; i++) frame(1 / 30, clip);
		expect(head.quaternion.angleTo(rest.multiply(nod))).toBeLessThan(2e-3);
		expect(neck.quaternion.angleTo(still)).toBeLessThan(2e-3);
	});

	it('belongs to an upright joint named head alone', () => {
		const { object, head } = body();
		head.rotation.set(Math.PI / 2, 0, 0);
		expect(Gaze.of(object)).toBeUndefined();
		head.rotation.set(0, 0, 0);
		head.name = 'tail';
		expect(Gaze.of(object)).toBeUndefined();
	});
});
