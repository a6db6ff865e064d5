import { describe, expect, it } from 'vitest';
import { FurGovernor, type FurGovernorOptions } from '../../../../web/fur/index.ts';

const target = 16;

/** A machine that draws: a fixed part and one that goes with the pixels, milliseconds at full resolution. */
class Machine {
	readonly governor: FurGovernor;
	/** When the scale changed, and to what. */
	readonly changes: { at: number; scale: number }[] = [];
	frames = 0;
	now = 0;
	#last = 1;

	constructor(
		options: FurGovernorOptions = {},
		/** Milliseconds of the display's refresh; 0 for times of the GPU */
		readonly refresh = 0,
	) {
		this.governor = new FurGovernor({ target, capped: refresh > 0, ...options });
	}

	/** @param cost of one frame at a scale; @param gap what is added to the interval of this frame */
	frame(cost: (scale: number) => number, moving = true, gap = 0): void {
		const drawn = this.#cost(cost(this.#last)) + gap;
		this.now += Math.max(drawn, this.refresh);
		const scale = this.governor.frame(drawn, this.now, moving);
		if (scale !== this.#last) this.changes.push({ at: this.now, scale });
		this.#last = scale;
		this.frames++;
	}

	#cost(time: number): number {
		return this.refresh ? Math.ceil(time / this.refresh - 1e-9) * this.refresh : time;
	}

	/** @param seconds of such frames */
	run(seconds: number, cost: (scale: number) => number, moving = true): void {
		for (const end = this.now + seconds * 1000; this.now < end; ) this.frame(cost, moving);
	}

	get scale(): number {
		return this.governor.scale;
	}
}

const pixels = (time: number) => (scale: number) => time * scale ** 2;

/** The same numbers 0..1 in every run. */
function random(): () => number {
	let state = 1;
	return () => {
		state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
		return state / 2 ** 32;
	};
}

describe.each([
	['times of the GPU', 0],
	['intervals at 60 Hz', 1000 / 60],
	['intervals at 120 Hz', 1000 / 120],
])('by %s', (_, refresh) => {
	const machine = (options: FurGovernorOptions = {}) =>
		new Machine({ target: refresh ? 18 : target, ...options }, refresh);

	it('leaves a light scene alone', () => {
		const one = machine();
		one.run(60, pixels(9));
		expect(one.changes).toEqual([]);
	});

	it('steps down in a heavy close-up within 40 frames, to a frame in time, and stays', () => {
		for (const load of [24, 33, 45, 56]) {
			const one = machine();
			one.run(5, pixels(9));
			const before = one.frames;
			while (one.governor.scale ** 2 * load > 18) one.frame(pixels(load));
			expect(one.frames - before, `${load} ms`).toBeLessThanOrEqual(40);
			const settled = one.now + 2000;
			one.run(30, pixels(load));
			const later = one.changes.filter(({ at }) => at > settled);
			// Where times don't show the room above it is tried, ever more rarely.
			expect(later.length, `${load} ms`).toBeLessThanOrEqual(refresh ? 10 : 0);
			expect(one.scale ** 2 * load).toBeLessThan(18.4);
		}
	});

	it('draws as many pixels as it can', () => {
		const one = machine();
		one.run(20, pixels(20));
		expect(one.scale).toBeGreaterThan(0.8);
		expect(one.scale).toBeLessThan(1);
	});

	it('steps up to the full resolution within 10 s when the load has gone', () => {
		const one = machine();
		one.run(3, pixels(60));
		expect(one.scale).toBeLessThan(0.75);
		one.run(10, pixels(5));
		expect(one.scale).toBe(1);
	});

	it('does not flap under noisy times around the target', () => {
		for (const spread of [0.1, 0.3, 0.5]) {
			const noise = random();
			const one = machine();
			one.run(120, (scale) => target * scale ** 2 * (1 + spread * (2 * noise() - 1)));
			const later = one.changes.filter(({ at }) => at > 60_000);
			expect(later.length, `spread ${spread}`).toBeLessThanOrEqual(2);
			expect(one.changes.length, `spread ${spread}`).toBeLessThanOrEqual(12);
		}
	});

	it('lets nobody wait where frames crawl: four of them are enough', () => {
		const one = machine({ merges: true });
		for (let frames = 0; one.scale === 1 && frames < 20; frames++) one.frame(pixels(3000));
		expect(one.frames).toBe(4);
		expect(one.scale).toBe(0.5);
	});

	it('leaves a light scene alone where two frames take long', () => {
		const one = machine();
		one.run(2, pixels(9));
		for (let i = 0; i < 2; i++) one.frame(pixels(9), true, 600);
		one.run(2, pixels(9));
		one.run(2, pixels(9), false);
		for (let i = 0; i < 4; i++) one.frame(pixels(9), true);
		for (let i = 0; i < 2; i++) one.frame(pixels(9), true, 600);
		one.run(2, pixels(9));
		expect(one.changes).toEqual([]);
	});

	it('ignores the gap of a hidden tab and single hiccups', () => {
		const one = machine();
		one.run(2, pixels(9));
		for (let i = 0; i < 8; i++) {
			one.frame(pixels(9), true, 10_000);
			one.run(0.5, pixels(9));
			one.frame(pixels(9), true, 150);
			one.frame(pixels(9), true, 150);
			one.run(0.5, pixels(9));
		}
		expect(one.changes).toEqual([]);
	});

	it('keeps its cooldown between any two changes', () => {
		const noise = random();
		const one = machine({ cooldown: 700, rest: 100 });
		for (let i = 0; i < 400; i++) {
			const load = 60 * noise();
			one.run(0.4 * noise(), pixels(load), noise() < 0.6);
		}
		expect(one.changes.length).toBeGreaterThan(20);
		const gaps = one.changes.slice(1).map(({ at }, i) => at - (one.changes[i]?.at ?? 0));
		expect(Math.min(...gaps)).toBeGreaterThanOrEqual(700);
	});

	it('draws what stands still at full resolution, and goes back when it moves', () => {
		const one = machine({ rest: 500, cooldown: 400 });
		one.run(5, pixels(40));
		let held = one.scale;
		for (const end = one.now + 1000; one.now < end && one.scale < 1; ) {
			held = one.scale;
			one.frame(pixels(40), false);
		}
		expect(held).toBeLessThan(0.9);
		expect(one.scale).toBe(1);
		one.run(20, pixels(40), false);
		expect(one.scale).toBe(1);
		one.frame(pixels(40));
		expect(one.scale).toBe(held);
	});

	it('learns from what stands still that there is room again', () => {
		const one = machine();
		one.run(40, pixels(60));
		one.run(2, pixels(5), false);
		const before = one.changes.length;
		one.run(5, pixels(5));
		expect(one.changes.length).toBe(before);
		expect(one.scale).toBe(1);
	});

	it('draws all pixels where fewer make nothing faster', () => {
		const one = machine();
		one.run(10, () => 40);
		expect(one.scale).toBe(1);
		const after = one.changes.length;
		one.run(20, () => 40);
		expect(one.changes.length).toBe(after);
	});

	it('goes to the lowest resolution, and no lower, under any load that pixels make', () => {
		const one = machine();
		one.run(60, pixels(400));
		expect(one.scale).toBe(0.5);
		const before = one.changes.length;
		one.run(60, pixels(900));
		expect(one.changes.length).toBe(before);
	});
});

it('takes no time for no frame', () => {
	const governor = new FurGovernor({ target });
	for (let i = 0; i < 600; i++) governor.frame(Number.NaN, i * 16, true);
	for (let i = 0; i < 600; i++) governor.frame(0, i * 16, true);
	expect(governor.scale).toBe(1);
});

it('moves in steps of √½ of the pixels', () => {
	const seen = new Set<number>([1]);
	for (const load of [20, 28, 38, 60]) {
		const one = new Machine();
		one.run(5, pixels(load));
		seen.add(Number(one.scale.toFixed(2)));
	}
	expect([...seen]).toEqual([1, 0.84, 0.71, 0.59, 0.5]);
});

describe('with shells that may be merged', () => {
	/** What is drawn after two seconds of frames of such a time, a quarter of which usual shells save, and merging again. */
	const drawn = (time: number, merges: boolean) => {
		const one = new Machine({ merges });
		const share = ({ coarseness, merging }: FurGovernor) => 0.75 ** (Number(coarseness === 1 && merges) + merging);
		one.run(2, (scale) => time * scale ** 2 * share(one.governor));
		const { coarseness, merging, scale } = one.governor;
		return { coarseness, merging, scale };
	};

	it('draws fewer, then merges them before it takes pixels away, and fewer of those', () => {
		expect(drawn(9, true)).toEqual({ coarseness: 2 / 3, merging: 0, scale: 1 });
		expect(drawn(18, true)).toEqual({ coarseness: 2 / 3, merging: 0, scale: 1 });
		expect(drawn(19, true)).toEqual({ coarseness: 1, merging: 0, scale: 1 });
		expect(drawn(25, true)).toEqual({ coarseness: 1, merging: 1, scale: 1 });
		expect(drawn(19, false)).toEqual({ coarseness: 1, merging: 0, scale: expect.closeTo(2 ** -0.25) });
		expect(drawn(30, true).merging).toBe(1);
		expect(drawn(30, true).scale).toBeGreaterThan(drawn(30, false).scale);
		expect(drawn(30, false).merging).toBe(0);
	});

	it('draws all of them at rest', () => {
		const one = new Machine({ merges: true });
		one.run(2, pixels(17.9));
		one.run(2, pixels(30));
		expect(one.governor.merging).toBe(1);
		one.run(2, pixels(30), false);
		expect([one.governor.coarseness, one.governor.merging, one.scale]).toEqual([2 / 3, 0, 1]);
		const slow = new Machine({ merges: true });
		slow.run(10, pixels(400));
		slow.run(2, pixels(400), false);
		expect([slow.governor.coarseness, slow.governor.merging, slow.scale]).toEqual([1, 0, 1]);
	});
});
