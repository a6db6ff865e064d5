/** Plot of decibels by bits per number. */

import type { LessonRecord } from '../data/measurements.ts';
import type { MeasuredWords } from '../words/index.ts';
import { axes, decimal, draw, mark, line as path } from './plot.ts';

/** @param bits present number */
export function drawBits(
	svg: SVGElement,
	width: number,
	height: number,
	entries: LessonRecord['bits'],
	bits: number,
	words: MeasuredWords,
): void {
	const values = entries.flatMap((entry) => [entry.psnr, entry.noise]);
	const [low, high] = [10 * Math.floor(Math.min(...values) / 10), 10 * Math.ceil(Math.max(...values) / 10)];
	const ticks = Array.from({ length: (high - low) / 10 + 1 }, (_, i) => low + 10 * i);
	const { x, y } = axes(
		svg,
		width,
		height,
		{ range: [2, 10], ticks: entries.map((entry) => entry.bits), label: words.bits },
		{ range: [low, high], ticks, label: words.decibels },
	);
	const now = entries.find((entry) => entry.bits === bits);
	draw(svg, 'line', { class: 'now', x1: x(bits), x2: x(bits), y1: y(low), y2: y(high) });
	for (const [key, kind, shape] of [
		['noise', 'eigen', 'square'],
		['psnr', 'ptm', 'dot'],
	] as const) {
		const points = entries.map((entry) => [x(entry.bits), y(entry[key])] as const);
		path(svg, points, kind);
		for (const [px, py] of points) mark(svg, shape, kind, px, py);
		if (!now) continue;
		const anchor = bits > 3 ? 'end' : 'start';
		const beside = x(bits) + (bits > 3 ? -8 : 8);
		draw(svg, 'text', { class: 'value', x: beside, y: y(now[key]) - 9, 'text-anchor': anchor }, decimal(now[key], 1));
	}
}
