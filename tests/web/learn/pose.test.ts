/** A limb whose joint turns under a lamp that stays: frames, moments, and hairs that go along. */

import { Matrix3, Matrix4, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { frameAt, inFrame, lightOf, momentsIn, type Vector } from '../../../web/learn/pose/frame.ts';
import { Hairs, radiusAt, watchedAt, weightAt } from '../../../web/learn/pose/hairs.ts';

const ANGLES = [-1.2, -0.3, 0, 0.5, 0.96, 1.9];
const LAMPS: Vector[] = [
	[-0.62, 0.62, 0.48],
	[0.6, 0.8, 0],
	[0, 1, 0],
	[0.1, 0.2, -0.97],
];
const vector = ([x, y, z]: Vector) => new Vector3(x, y, z);

describe('the frame of a vertex', () => {
	it.each(ANGLES)('is right-handed and of unit vectors at %f', (angle) => {
		const { tangent, bitangent, normal } = frameAt(angle);
		const matrix = new Matrix3().set(...tangent, ...bitangent, ...normal);
		expect(matrix.determinant()).toBeCloseTo(1, 12);
		expect(vector(normal).cross(vector(tangent)).distanceTo(vector(bitangent))).toBeLessThan(1e-12);
	});

	it('turned under a lamp sees what it sees at rest under a lamp that is turned back', () => {
		for (const angle of ANGLES)
			for (const lamp of LAMPS) {
				const back = vector(lamp).applyMatrix4(new Matrix4().makeRotationZ(-angle));
				const [x, , z] = [back.x, back.y, back.z];
				const seen = inFrame(frameAt(angle), lamp);
				// At rest T is x, B is −z, N is y.
				for (const [i, expected] of [x, -z, back.y].entries()) expect(seen[i]).toBeCloseTo(expected, 12);
			}
	});

	it('has the six moments of the article', () => {
		const [u, v] = [-0.62, -0.48];
		const expected = [u * u, v * v, u * v, u, v, 1];
		for (const [i, value] of momentsIn(frameAt(0), [-0.62, 0.62, 0.48]).entries())
			expect(value).toBeCloseTo(expected[i] as number, 12);
		// Facing the lamp all that is left is the constant.
		const facing = momentsIn(frameAt(Math.PI / 4), [-Math.SQRT1_2, Math.SQRT1_2, 0]);
		for (const [i, value] of facing.entries()) expect(value).toBeCloseTo(i === 5 ? 1 : 0, 12);
	});

	it('gets nothing from a lamp right below the skin', () => {
		expect(lightOf([1, 1, 1, 1, 1, 1], momentsIn(frameAt(0), [0, -1, 0]))).toBe(0);
		expect(lightOf([0, 0, 0, 0, 0, -3], [0, 0, 0, 0, 0, 1])).toBe(0);
	});
});

describe('hairs of the limb', () => {
	const all = (angle: number) => {
		const found: { root: Vector3; tip: Vector3; normal: Vector3; tangent: Vector3 }[] = [];
		new Hairs().pose(angle, ({ root, tip, frame }) =>
			found.push({
				...{ root: vector(root), tip: vector(tip) },
				...{ normal: vector(frame.normal), tangent: vector(frame.tangent) },
			}),
		);
		return found;
	};

	it('are carried by the joint beyond it, and stay where they are before it', () => {
		const rest = all(0);
		const turn = new Matrix4().makeRotationZ(0.9);
		let moved = 0;
		all(0.9).forEach((hair, i) => {
			const before = rest[i] as (typeof rest)[0];
			const weight = weightAt(before.root.x);
			if (weight > 0 && weight < 1) return;
			if (weight === 1) moved++;
			for (const key of ['root', 'tip', 'normal', 'tangent'] as const) {
				const expected = before[key].clone();
				if (weight === 1) expected.applyMatrix4(turn);
				expect(hair[key].distanceTo(expected)).toBeLessThan(1e-12);
			}
		});
		expect(moved).toBeGreaterThan(500);
	});

	it('stand on the skin, out of it', () => {
		for (const { root, tip, normal } of all(0)) {
			expect(Math.hypot(root.y, root.z)).toBeCloseTo(radiusAt(root.x), 12);
			expect(tip.clone().sub(root).dot(normal)).toBeGreaterThan(0);
		}
	});

	it('the watched vertex is where its bone has brought it', () => {
		const rest = vector(watchedAt(0));
		for (const angle of ANGLES) {
			const expected = rest.clone().applyMatrix4(new Matrix4().makeRotationZ(angle));
			expect(vector(watchedAt(angle)).distanceTo(expected)).toBeLessThan(1e-12);
		}
	});
});
