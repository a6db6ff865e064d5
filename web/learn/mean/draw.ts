/** Pictures of averaged squares, and the plot of their errors. */

import type { Lesson } from '../lesson.ts';
import type { RGB } from '../plot/colours.ts';
import { axes, draw, mark, line as path } from '../plot/plot.ts';
import type { BlockErrors, Blocks } from './blocks.ts';

/** Mean coverage of a square, in bytes, from which it is opaque, and opacity of the faintest. */
const [WHOLE, FAINTEST] = [76, 0.35];

/** Fills a canvas with squares, fainter with less hair; v grows upwards. */
export function drawBlocks(
	canvas: HTMLCanvasElement,
	{ across, cover, mean }: Blocks,
	side: number,
	colour: (v: number) => RGB,
) {
	const context = canvas.getContext('2d');
	if (!context) return;
	const { width, height } = canvas;
	context.clearRect(0, 0, width, height);
	const edge = (i: number, whole: number) => Math.round((i * whole) / across);
	mean.forEach((value, i) => {
		const share = (cover[i] ?? 0) / side ** 2 / WHOLE;
		if (!share) return;
		const [r, g, b] = colour(value);
		const [column, row] = [i % across, across - 1 - Math.floor(i / across)];
		const [x, y] = [edge(column, width), edge(row, height)];
		context.fillStyle = `rgb(${r} ${g} ${b} / ${FAINTEST + (1 - FAINTEST) * Math.min(share, 1)})`;
		context.fillRect(x, y, edge(column + 1, width) - x, edge(row + 1, height) - y);
	});
}

/** Errors by the side of the squares. @param exponent of the present side */
export function drawErrors(
	svg: SVGElement,
	width: number,
	height: number,
	errors: readonly BlockErrors[],
	exponent: number,
	words: Lesson['words']['mean'],
): void {
	const top = 10 * Math.ceil(10 * Math.max(...errors.map(({ all }) => all)));
	const { x, y } = axes(
		svg,
		width,
		height,
		{
			range: [-0.3, errors.length - 0.7],
			ticks: errors.map((_, i) => i),
			label: words.side,
			text: (i) => words.square(2 ** i),
		},
		{ range: [0, top], ticks: Array.from({ length: top / 10 + 1 }, (_, i) => 10 * i), label: words.percent },
	);
	draw(svg, 'line', { class: 'now', x1: x(exponent), x2: x(exponent), y1: y(0), y2: y(top) });
	for (const [key, kind, shape] of [
		['all', 'ptm', 'dot'],
		['own', 'eigen', 'square'],
	] as const) {
		const points = errors.map((error, i) => [x(i), y(100 * error[key])] as const);
		path(svg, points, kind);
		for (const [px, py] of points) mark(svg, shape, kind, px, py);
	}
}
