/** Plots on numbers per texel: light along an arc of lamps, and decibels. */

import type { Direction } from '../../fur/reference.ts';
import { relitTexels } from '../data/fit.ts';
import type { RelitLayer } from '../data/relit.ts';
import type { Selection } from '../data/Selection.ts';
import type { MeasuredWords } from '../words/index.ts';
import { axes, decimal, draw, mark, line as path } from './plot.ts';

const ARC_STEPS = 80;

/**
 * Draws the selected texel's light along the arc, measured and by both kinds of numbers.
 *
 * @param light unit vector to the lamp, tile axes
 */
export function drawArc(
	svg: SVGElement,
	width: number,
	height: number,
	{
		selection,
		relit,
		light,
		words,
	}: {
		selection: Selection;
		relit: RelitLayer;
		light: Direction;
		words: MeasuredWords;
	},
): void {
	const { record } = selection;
	const first = record.lights.length - record.angles.length;
	const measured = record.angles.map(
		(angle, i) => [angle, selection.measured(first + i)[selection.place] ?? 0] as const,
	);
	const top = Math.max(1, Math.ceil(Math.max(...measured.map(([, value]) => value)) + 0.2));
	const ticks = Array.from({ length: top + 1 }, (_, i) => i);
	const { x, y } = axes(
		svg,
		width,
		height,
		{ range: [-90, 90], ticks: [-80, -40, 0, 40, 80], label: words.arcAxis, text: (value) => decimal(value, 0) },
		{ range: [0, top], ticks, label: words.light },
	);
	const [, lv, lz] = light;
	const now = (Math.atan2(lv, lz) * 180) / Math.PI;
	draw(svg, 'line', { class: 'now', x1: x(now), x2: x(now), y1: y(0), y2: y(top) });
	for (const kind of ['ptm', 'eigen'] as const) {
		const { curves, numbers } = relit.by(kind);
		const own = numbers.subarray(selection.place * relit.count, (selection.place + 1) * relit.count);
		const points = Array.from({ length: ARC_STEPS + 1 }, (_, i) => {
			const angle = ((2 * i) / ARC_STEPS - 1) * 84;
			const [s, c] = [Math.sin((angle * Math.PI) / 180), Math.cos((angle * Math.PI) / 180)];
			const [value = 0] = relitTexels(own, curves([0, s, c]));
			return [x(angle), y(Math.min(value, top))] as const;
		});
		path(svg, points, kind);
	}
	for (const [angle, value] of measured) mark(svg, 'ring', 'truth', x(angle), y(value));
}

/** Decibels by numbers per texel, of each kind. */
export type Decibels = Record<'ptm' | 'eigen' | 'best', readonly { numbers: number; psnr: number }[]>;

/** Draws decibels by numbers per texel. @param count present number */
export function drawDecibels(
	svg: SVGElement,
	width: number,
	height: number,
	figures: Decibels,
	count: number,
	words: MeasuredWords,
): void {
	const all = Object.values(figures).flatMap((rows) => rows.map(({ psnr: db }) => db));
	const [low, high] = [2 * Math.floor(Math.min(...all) / 2), 2 * Math.ceil(Math.max(...all) / 2)];
	const ticks = Array.from({ length: (high - low) / 2 + 1 }, (_, i) => low + 2 * i);
	const { x, y } = axes(
		svg,
		width,
		height,
		{ range: [0.6, 8.4], ticks: figures.best.map(({ numbers }) => numbers), label: words.numbersAxis },
		{ range: [low, high], ticks, label: words.decibels },
	);
	draw(svg, 'line', { class: 'now', x1: x(count), x2: x(count), y1: y(low), y2: y(high) });
	for (const [kind, shape] of [
		['best', 'diamond'],
		['eigen', 'square'],
		['ptm', 'dot'],
	] as const) {
		const points = figures[kind].map(({ numbers, psnr: db }) => [x(numbers), y(db)] as const);
		path(svg, points, kind);
		for (const [px, py] of points) mark(svg, shape, kind, px, py);
	}
}
