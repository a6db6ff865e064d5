import { Matrix4, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { FurFollicles } from '../../../../web/fur/body/FurFollicles.ts';
import { Strokes } from '../../../../web/fur/motion/Strokes.ts';

/** Hairs on a plane at y = 0, a tenth apart, upright. */
const side = 21;
const follicles = {
	count: side * side,
	position: Float32Array.from({ length: 3 * side * side }, (_, c) => {
		const i = Math.floor(c / 3);
		return [(i % side) / 10 - 1, 0, Math.floor(i / side) / 10 - 1][c % 3] as number;
	}),
	normal: Float32Array.from({ length: 3 * side * side }, (_, c) => (c % 3 === 1 ? 1 : 0)),
	comb: new Float32Array(3 * side * side),
} as unknown as FurFollicles;

/** Where a stroke along x has led the hair at (0, z), in tenths. @param parts that its way is cut into */
function lane(parts = 1): (z: number) => [number, number, number] {
	const strokes = new Strokes(follicles, 1e6);
	const at = (share: number) => new Vector3(-1 + 2 * share, 0, 0);
	for (let i = 0; i < parts; i++) {
		strokes.add(at(i / parts), at((i + 1) / parts), new Matrix4(), 0.55);
		strokes.finish();
	}
	return (z) => {
		const i = 10 + side * (10 + z);
		return [0, 1, 2].map((c) => strokes.fade * (strokes.offsets[4 * i + c] as number)) as [number, number, number];
	};
}

describe('a stroke', () => {
	it('lays hairs along its way in its middle, and parts them at its rim', () => {
		const offset = lane();
		const [along, up, aside] = offset(0);
		expect(along).toBeGreaterThan(0.8);
		expect(Math.abs(up) + Math.abs(aside)).toBeLessThan(1e-6);
		for (const z of [2, 3, 4]) {
			const [left, right] = [offset(-z), offset(z)];
			expect(right[2]).toBeGreaterThan(0.2);
			expect(left[2]).toBeCloseTo(-right[2], 6);
			expect(left[0]).toBeCloseTo(right[0], 6);
			expect(right[0]).toBeGreaterThan(0.05);
			// The nearer to the rim, the more aside.
			const [before, , less] = offset(z - 1);
			expect(right[2] / right[0]).toBeGreaterThan(less / before + 0.1);
		}
		expect(offset(6)).toEqual([0, 0, 0]);
	});

	it('leaves the same lane however its way is cut', () => {
		const [whole, cut] = [lane(), lane(7)];
		for (const z of [0, 1, 2, 3, 4, 5])
			for (const c of [0, 1, 2]) expect(cut(z)[c]).toBeCloseTo(whole(z)[c] as number, 5);
	});
});

describe('a lane', () => {
	it('stays as it was laid a while, and is over before ten times its relaxation', () => {
		const strokes = new Strokes(follicles, 0.5);
		strokes.add(new Vector3(-1, 0, 0), new Vector3(1, 0, 0), new Matrix4(), 0.55);
		strokes.finish();
		const middle = () => strokes.fade * (strokes.offsets[4 * (10 + side * 10)] as number);
		let seconds = 0;
		for (; strokes.widest > 0; seconds += 1 / 30) {
			// No hair goes farther than that: what is beyond is seen as if it stayed.
			if (seconds < 0.1) expect(middle()).toBeGreaterThan(0.8);
			expect(middle()).toBeLessThanOrEqual(strokes.widest);
			strokes.advance(0, 1);
		}
		expect(seconds).toBeGreaterThan(1);
		expect(seconds).toBeLessThan(5);
		expect(strokes.offsets.every((offset) => offset === 0)).toBe(true);
	});
});
