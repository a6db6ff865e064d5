import { describe, expect, it } from 'vitest';
import {
	eulerLimit,
	eulerPath,
	exactPath,
	farthest,
	type Oscillator,
	truth,
} from '../../../web/learn/swing/oscillator.ts';

const SECONDS = 2;
const spring: Oscillator = { frequency: 3, damping: 0.15, rest: 0.1, from: 0.7 };
const STEPS = [1 / 240, 1 / 60, 1 / 30, 1 / 7, 1 / 2];

/** x after some time by the classical Runge–Kutta method in very short steps: knows nothing of sines. */
function integrated({ frequency, damping, rest, from }: Oscillator, time: number): number {
	const w = 2 * Math.PI * frequency;
	const pull = (x: number, v: number) => -2 * damping * w * v - w * w * (x - rest);
	const count = 4000;
	const h = time / count;
	let [x, v] = [from, 0];
	for (let i = 0; i < count; i++) {
		const [x1, v1] = [v, pull(x, v)];
		const [x2, v2] = [v + (h / 2) * v1, pull(x + (h / 2) * x1, v + (h / 2) * v1)];
		const [x3, v3] = [v + (h / 2) * v2, pull(x + (h / 2) * x2, v + (h / 2) * v2)];
		const [x4, v4] = [v + h * v3, pull(x + h * x3, v + h * v3)];
		x += (h / 6) * (x1 + 2 * x2 + 2 * x3 + x4);
		v += (h / 6) * (v1 + 2 * v2 + 2 * v3 + v4);
	}
	return x;
}

describe('the spring of the lesson', () => {
	it.each([spring, { ...spring, frequency: 1, damping: 0.95 }, { ...spring, frequency: 6, from: -0.8, rest: 0 }])(
		'has the true curve of %o',
		(of) => {
			for (const time of [0, 0.05, 0.3, 1, SECONDS]) expect(truth(of, time)).toBeCloseTo(integrated(of, time), 8);
		},
	);

	it.each(STEPS)('by the library’s exact step of %f s is on the curve', (dt) => {
		const path = exactPath(spring, dt, SECONDS);
		expect(path.length).toBe(Math.floor(SECONDS / dt + 1e-6) + 1);
		expect(farthest(path, spring, dt)).toBeLessThan(1e-6);
	});

	it('by Euler’s flies off as soon as its steps are longer than the limit, and only then', () => {
		const limit = eulerLimit(spring);
		const swings = (dt: number) =>
			Math.max(
				...eulerPath(spring, dt, 40)
					.slice(-100)
					.map((x) => Math.abs(x - spring.rest)),
			);
		expect(swings(limit * 0.97)).toBeLessThan(0.1);
		expect(swings(limit * 1.03)).toBeGreaterThan(3);
		expect(farthest(eulerPath(spring, 1 / 2, SECONDS), spring, 1 / 2)).toBeGreaterThan(100);
	});
});
