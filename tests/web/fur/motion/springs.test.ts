import { describe, expect, it } from 'vitest';
import type { FurFollicles } from '../../../../web/fur/body/FurFollicles.ts';
import { CpuSprings } from '../../../../web/fur/motion/CpuSprings.ts';
import { calm, type Drive } from '../../../../web/fur/motion/drive.ts';
import { rootsOf } from '../../../../web/fur/motion/roots.ts';
import { Strokes } from '../../../../web/fur/motion/Strokes.ts';
import { LIMIT, STEP, springOf } from '../../../../web/fur/motion/spring.ts';

/** Numbers in −1..1, always the same ones. */
function noise(): () => number {
	let state = 1;
	return () => {
		state = (state * 48271) % 2147483647;
		return (2 * state) / 2147483647 - 1;
	};
}

type Vector = [number, number, number];
const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const plus = (a: Vector, b: Vector, share = 1) => a.map((c, i) => c + share * (b[i] as number)) as Vector;
const flat = (a: Vector, n: Vector) => plus(a, n, -dot(a, n));
const norm = (a: Vector) => Math.hypot(...a);

/** Some hairs with normals about y, and edges between them. */
function patch(count: number, edges: [number, number][]): FurFollicles {
	const next = noise();
	const vectors = (make: (i: number) => Vector) =>
		Float32Array.from(Array.from({ length: count }, (_, i) => make(i)).flat());
	const normals = Array.from({ length: count }, () => {
		const n: Vector = [0.4 * next(), 1, 0.4 * next()];
		return n.map((c) => c / norm(n)) as Vector;
	});
	const both = [...edges, ...edges.map(([a, b]) => [b, a] as const)].sort(([a, b], [c, d]) => a - c || b - d);
	return {
		count,
		position: vectors(() => [next(), next(), next()]),
		normal: vectors((i) => normals[i] as Vector),
		comb: vectors((i) => flat([0.2, 0, 0.1 * next()], normals[i] as Vector)),
		length: Float32Array.from({ length: count }, () => 0.7 + 0.3 * next()),
		first: Uint32Array.from({ length: count + 1 }, (_, i) => both.filter(([a]) => a < i).length),
		links: Uint32Array.from(both, ([, b]) => b),
	} as unknown as FurFollicles;
}

const edges: [number, number][] = [
	[0, 1],
	[1, 2],
	[2, 3],
	[3, 0],
	[0, 2],
	[3, 4],
	[4, 5],
];

function solverOf(follicles: FurFollicles, coupling: number, frequency = 2.4, damping = 0.22) {
	const spring = springOf(frequency, damping);
	return { spring, solver: new CpuSprings(rootsOf(follicles, coupling), spring, new Strokes(follicles, 1)) };
}

const at = (values: Float32Array, i: number, stride = 3, from = 0) =>
	[...values.subarray(stride * i + from, stride * i + from + 3)] as Vector;

/** Rows of the velocity that the skin of a body adds. */
const kick = ({ joints }: Drive) => joints.subarray(12, 24);

/** Gravity of a body that is not turned. */
function pull(drive: Drive, displacement: Vector): void {
	drive.pull.set(displacement);
	drive.sags = true;
}

describe('springOf', () => {
	it.each([
		[2.4, 0.22],
		[0.3, 0.9],
		[15, 0.05],
	])('of %f Hz and ζ = %f steps as a thousand Runge-Kutta steps do', (frequency, damping) => {
		const { xx, xv, vx, vv, pace } = springOf(frequency, damping);
		const force = (x: number, v: number) => -(pace ** 2) * x - 2 * damping * pace * v;
		for (const [x0, v0] of [
			[1, 0],
			[0, 1],
		] as const) {
			let [x, v] = [x0 as number, v0 as number];
			const h = STEP / 1000;
			for (let i = 0; i < 1000; i++) {
				const [a1, b1] = [v, force(x, v)];
				const [a2, b2] = [v + 0.5 * h * b1, force(x + 0.5 * h * a1, v + 0.5 * h * b1)];
				const [a3, b3] = [v + 0.5 * h * b2, force(x + 0.5 * h * a2, v + 0.5 * h * b2)];
				const [a4, b4] = [v + h * b3, force(x + h * a3, v + h * b3)];
				x += (h / 6) * (a1 + 2 * a2 + 2 * a3 + a4);
				v += (h / 6) * (b1 + 2 * b2 + 2 * b3 + b4);
			}
			expect(xx * x0 + xv * v0).toBeCloseTo(x, 9);
			expect((vx * x0 + vv * v0) / pace).toBeCloseTo(v / pace, 9);
		}
	});
});

describe('CpuSprings', () => {
	/**
	 * The same by other means: the exchange as edges one by one, the spring by Runge-Kutta steps under an acceleration, the
	 * skin's velocity as jumps of the hair's.
	 */
	function oracle(
		follicles: FurFollicles,
		coupling: number,
		drive: Drive,
		steps: number,
		frequency: number,
		damping: number,
	) {
		const { count } = follicles;
		const pace = 2 * Math.PI * frequency;
		const normal = (i: number) => at(follicles.normal, i);
		const degree = (i: number) => edges.filter((edge) => edge.includes(i)).length;
		let x = Array.from({ length: count }, (): Vector => [0, 0, 0]);
		let v = Array.from({ length: count }, (): Vector => [0, 0, 0]);
		const give = (old: Vector[]) => {
			const moved = old.map((a): Vector => [...a]);
			for (const [a, b] of edges) {
				const weight = (0.5 * coupling) / (1 + Math.max(degree(a), degree(b)));
				const [from, to] = [old[a] as Vector, old[b] as Vector];
				moved[a] = plus(moved[a] as Vector, plus(to, from, -1), weight);
				moved[b] = plus(moved[b] as Vector, plus(from, to, -1), weight);
			}
			return moved.map((a, i) => flat(a, normal(i)));
		};
		const kicks = Array.from({ length: count }, (_, i) => {
			const p = at(follicles.position, i);
			const row = (r: number) => dot(at(kick(drive), r, 4), p) + (kick(drive)[4 * r + 3] as number);
			return flat([row(0), row(1), row(2)], normal(i)).map((c) => c * (follicles.length[i] as number)) as Vector;
		});
		for (let step = 0; step < steps; step++) {
			[x, v] = [give(x), give(v)];
			for (let i = 0; i < count; i++) {
				const pull = flat([...drive.pull] as Vector, normal(i)).map(
					(c) => pace ** 2 * (follicles.length[i] as number) * c,
				) as Vector;
				let [y, u] = [x[i] as Vector, plus(v[i] as Vector, kicks[i] as Vector, 0.5)];
				const force = (y: Vector, u: Vector) => plus(plus(pull, y, -(pace ** 2)), u, -2 * damping * pace);
				const h = STEP / 50;
				for (let n = 0; n < 50; n++) {
					const [a1, b1] = [u, force(y, u)];
					const [a2, b2] = [plus(u, b1, h / 2), force(plus(y, a1, h / 2), plus(u, b1, h / 2))];
					const [a3, b3] = [plus(u, b2, h / 2), force(plus(y, a2, h / 2), plus(u, b2, h / 2))];
					const [a4, b4] = [plus(u, b3, h), force(plus(y, a3, h), plus(u, b3, h))];
					y = plus(plus(plus(plus(y, a1, h / 6), a2, h / 3), a3, h / 3), a4, h / 6);
					u = plus(plus(plus(plus(u, b1, h / 6), b2, h / 3), b3, h / 3), b4, h / 6);
				}
				x[i] = y;
				v[i] = plus(u, kicks[i] as Vector, 0.5);
			}
		}
		return x;
	}

	it.each([0, 0.3, 1])('goes as Runge-Kutta steps between exchanges do, coupling %f', (coupling) => {
		const follicles = patch(6, edges);
		const { solver } = solverOf(follicles, coupling);
		const drive = calm();
		pull(drive, [0.1, -0.05, 0.07]);
		const next = noise();
		kick(drive).set(Float32Array.from({ length: 12 }, () => 0.05 * next()));
		drive.kicks = true;
		for (let step = 0; step < 40; step++) solver.step(drive);
		const ideal = oracle(follicles, coupling, drive, 40, 2.4, 0.22);
		for (const [i, wanted] of ideal.entries()) {
			expect(norm(wanted)).toBeGreaterThan(0.02);
			expect(norm(plus(at(solver.after, i, 6), wanted, -1))).toBeLessThan(1e-5);
		}
	});

	const energies = ({ after }: CpuSprings, pace: number) =>
		Array.from(after).reduce((sum, c, i) => sum + (i % 6 < 3 ? pace ** 2 : 1) * c * c, 0);

	it.each([0, 0.5, 1])('never has more energy than before without a force, coupling %f', (coupling) => {
		const next = noise();
		for (let trial = 0; trial < 40; trial++) {
			const { solver, spring } = solverOf(patch(6, edges), coupling, 0.5 + 3 * (trial % 7), 0.05 + 0.1 * (trial % 9));
			// Many of them beyond the limits, across the tangent plane, and faster than anything may be.
			for (let i = 0; i < solver.after.length; i++) solver.after[i] = next() * (i % 6 < 3 ? 1 : 5 * spring.pace);
			const drive = calm();
			let before = energies(solver, spring.pace);
			for (let step = 0; step < 60; step++) {
				solver.step(drive);
				const now = energies(solver, spring.pace);
				expect(now).toBeLessThanOrEqual(before * (1 + 1e-6));
				before = now;
			}
		}
	});

	it('comes to rest no later than the bound tells, and to the rest exactly where it was there', () => {
		const next = noise();
		for (const coupling of [0, 0.7]) {
			const { solver, spring } = solverOf(patch(6, edges), coupling);
			solver.step(calm());
			expect([...solver.after].every((c) => c === 0)).toBe(true);
			for (let i = 0; i < solver.after.length; i++) solver.after[i] = next() * (i % 6 < 3 ? 1 : 4 * spring.pace);
			let bound = spring.widest;
			while (bound > 1e-3) {
				solver.step(calm());
				bound *= spring.decay;
			}
			for (let i = 0; i < 6; i++) expect(norm(at(solver.after, i, 6))).toBeLessThan(1e-3);
		}
	});

	it('commutes with the exchange where springs are all alike: the order of the two is nowhere seen', () => {
		const follicles = patch(6, edges);
		follicles.comb.fill(0);
		const next = noise();
		const start = Float32Array.from({ length: 36 }, (_, i) => 0.05 * next() * (i % 6 < 3 ? 1 : 15));
		const run = (couplings: number[]) => {
			let states: Float32Array = start;
			for (const coupling of couplings) {
				const { solver } = solverOf(follicles, coupling);
				solver.after.set(states);
				solver.step(calm());
				states = solver.after;
			}
			return states;
		};
		// Out of the tangent planes first, where the exchange is no projection.
		const flatten = run([0]);
		start.set(flatten);
		const [early, late] = [run([1, 0]), run([0, 1])];
		for (const [i, c] of early.entries())
			expect(Math.abs(c - (late[i] as number))).toBeLessThan(i % 6 < 3 ? 1e-6 : 1e-5);
	});

	it('keeps tips within the limit and in their tangent planes under any force', () => {
		const follicles = patch(6, edges);
		const { solver } = solverOf(follicles, 0.4);
		const drive = calm();
		drive.kicks = true;
		const next = noise();
		for (let step = 0; step < 200; step++) {
			pull(drive, [30 * next(), 30 * next(), 30 * next()]);
			kick(drive).set(Float32Array.from({ length: 12 }, () => 200 * next()));
			solver.step(drive);
			for (let i = 0; i < 6; i++) {
				const x = at(solver.after, i, 6);
				expect(norm(plus(x, at(follicles.comb, i)))).toBeLessThanOrEqual(LIMIT + 1e-6);
				expect(Math.abs(dot(x, at(follicles.normal, i)))).toBeLessThan(1e-6);
			}
		}
	});

	it('shows what lies between two sub-steps', () => {
		const { solver } = solverOf(patch(6, edges), 0.3);
		const drive = calm();
		pull(drive, [0.2, 0, 0]);
		for (let step = 0; step < 5; step++) solver.step(drive);
		solver.show(0.25);
		const texels = solver.swing.image.data as Float32Array;
		for (let i = 0; i < 6; i++)
			for (let c = 0; c < 3; c++) {
				const [from, to] = [solver.before[6 * i + c] as number, solver.after[6 * i + c] as number];
				expect(texels[4 * i + c]).toBeCloseTo(0.75 * from + 0.25 * to, 6);
			}
	});
});
