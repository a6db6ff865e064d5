/** Where tips are does not depend on how often frames are drawn. */

import { describe, expect, it } from 'vitest';
import { FurMotion } from '../../../../web/fur/motion/FurMotion.ts';
import { swingOf } from '../furs.ts';
import { apart, ball, finger, largest, shake } from './ball.ts';

/** Everything at once. @returns where the tips are after some seconds */
function path(
	rate: number,
	seconds: number,
	options: { strength: number; shaken: boolean; stroked: boolean },
): Float32Array {
	const body = ball();
	const motion = new FurMotion(body.fur, { coupling: 0.5 });
	motion.wind.strength = options.strength;
	motion.wind.gusts = 1;
	motion.wind.direction.set(1, 0.2, -0.5);
	if (options.shaken) shake(body, 0);
	body.fur.shells.updateWorldMatrix(true, false);
	motion.settle();
	for (let i = 1, before = 0; before < seconds; i++) {
		const now = Math.min(i / rate, seconds);
		// A finger goes over the skin, wherever the body is.
		if (options.stroked && before < 0.75) {
			const { matrixWorld } = body.fur.shells;
			motion.stroke(finger(before).applyMatrix4(matrixWorld), finger(now).applyMatrix4(matrixWorld), 0.4);
		}
		if (options.shaken) shake(body, now);
		motion.update(now - before);
		before = now;
	}
	return swingOf(body);
}

describe('the path', () => {
	it.each([
		['in gusts', { strength: 0.5, shaken: false, stroked: false }],
		['of a shaken body', { strength: 0, shaken: true, stroked: false }],
		['under a finger', { strength: 0, shaken: false, stroked: true }],
		['under all of it', { strength: 0.5, shaken: true, stroked: true }],
	])('%s ends at 30, 60 and 144 Hz within 1 % of the length of where it ends at 1000 Hz', (_, options) => {
		for (const seconds of [0.5, 0.83, 2]) {
			const ideal = path(1000, seconds, options);
			expect(largest(ideal)).toBeGreaterThan(0.1);
			for (const rate of [30, 60, 144])
				expect(apart(path(rate, seconds, options), ideal), `${rate} Hz, ${seconds} s`).toBeLessThan(0.01);
		}
	});
});
