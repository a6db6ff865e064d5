import { describe, expect, it } from 'vitest';
import { apart, plot, steps } from '../../../web/bench/plot.ts';

describe('the marks of an axis', () => {
	it.each([
		[700, [0, 200, 400, 600, 800]],
		[1, [0, 0.2, 0.4, 0.6, 0.8, 1]],
		[0.13, [0, 0.05, 0.1, 0.15]],
		[30, [0, 10, 20, 30]],
		[0, [0, 1]],
	])('up to %d', (most, expected) => {
		expect(steps(most)).toEqual(expected);
	});

	it('are three to six steps that reach every value', () => {
		for (let most = 0.01; most < 5000; most *= 1.07) {
			const marks = steps(most);
			expect(marks.length).toBeGreaterThanOrEqual(3);
			expect(marks.length).toBeLessThanOrEqual(7);
			expect(marks.at(-1)).toBeGreaterThanOrEqual(most * (1 - 1e-6));
			expect(marks.at(-2)).toBeLessThan(most);
		}
	});
});

describe('names beside lines', () => {
	it('stay where they are wanted if there is room', () => {
		expect(apart([100, 20, 60], 15, 200)).toEqual([100, 20, 60]);
	});

	it('make room for each other in their own order, above the lowest place', () => {
		expect(apart([100, 98], 15, 200)).toEqual([113, 98]);
		expect(apart([198, 199, 200], 15, 200)).toEqual([170, 185, 200]);
	});
});

describe('a plot', () => {
	const axes = { title: 'Shells & more', x: 'shells', y: 'ms', ticks: [8, 16, 32, 64] };
	const series = [
		{
			name: 'PTM',
			kind: 'ptm',
			points: [
				[8, 50],
				[64, 400],
			] as const,
		},
	];
	const path = (svg: string) =>
		/<path d="M([\d. L]+)"/
			.exec(svg)?.[1]
			?.split('L')
			.map((pair) => pair.split(' ').map(Number));

	it('puts points where their values are', () => {
		const [[x0 = 0, y0 = 0] = [], [x1 = 0, y1 = 0] = []] = path(plot(series, axes)) ?? [];
		const bottom = 210;
		expect(x1).toBe(300);
		expect(x0).toBe(46);
		expect((bottom - y0) / (bottom - y1)).toBeCloseTo(50 / 400, 2);
	});

	it('has equal ratios side by side on a logarithmic axis', () => {
		const points = axes.ticks.map((tick) => [tick, 1] as const);
		const xs = path(plot([{ name: 'a', kind: 'ptm', points }], { ...axes, log: true }))?.map(([x = 0]) => x) ?? [];
		const gaps = xs.slice(1).map((x, i) => x - (xs[i] ?? 0));
		for (const gap of gaps) expect(gap).toBeCloseTo(254 / 3, 0);
	});

	it('leaves out ticks that would run into the next', () => {
		const marked = (ticks: number[]) =>
			[...plot(series, { ...axes, ticks }).matchAll(/class="tick middle"[^>]*>([^<]*)</g)].map(([, text]) => text);
		expect(marked([8, 16, 32, 64])).toEqual(['64', '32', '16', '8']);
		expect(marked([8, 10, 32, 64])).toEqual(['64', '32', '10']);
	});

	it('is words, too, and its words are no markup', () => {
		const svg = plot(series, axes);
		expect(svg).toContain('aria-label="Shells &#38; more. PTM 8: 50, 64: 400"');
		expect(svg).not.toMatch(/NaN|undefined/);
	});
});
