/** Plot of decibels by bits per number. */

import type { LessonRecord } from '../data/measurements.ts';
import type { MeasuredWords } from '../words/index.ts';
import { axes, decimal, draw, mark, line as path } from './plot.ts';

/** Room for a value below the lowest point, tens of decibels. */
const ROOM = 0.8;

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
	const [low, high] = [10 * Math.floor(Math.min(...values) / 10 - ROOM), 10 * Math.ceil(Math.max(...values) / 10)];
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
	// Values stand above the higher line and below the lower one.
	for (const [key, kind, shape, off] of [
		['noise', 'eigen', 'square', -9],
		['psnr', 'ptm', 'dot', 18],
	] as const) {
		const points = entries.map((entry) => [x(entry.bits), y(entry[key])] as const);
		path(svg, points, kind);
		for (const [px, py] of points) mark(svg, shape, kind, px, py);
		if (!now) continue;
		const anchor = bits > 3 ? 'end' : 'start';
		const beside = x(bits) + (bits > 3 ? -8 : 8);
		draw(svg, 'text', { class: 'value', x: beside, y: y(now[key]) + off, 'text-anchor': anchor }, decimal(now[key], 1));
	}
}
