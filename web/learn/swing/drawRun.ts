/** Plot of a release: the solution as a line, steps as marks. */

import { axes, decimal, draw, mark, line as path, type Scale } from '../plot/plot.ts';
import { truth } from './oscillator.ts';
import { SECONDS, type SpringRun } from './SpringRun.ts';

/** Bound of Euler's path, far outside of the picture. */
const OUTSIDE = 50;
/** Smallest distance of marks, pixels; of shorter steps some have none. */
const MARKED = 8;
const CURVE_POINTS = 400;

/** @returns scales of time and displacement, and the group that is clipped at the axes */
function frame(svg: SVGElement, width: number, height: number, words: { seconds: string; lengths: string }) {
	const { x, y } = axes(
		svg,
		width,
		height,
		{ range: [0, SECONDS], ticks: [0, 0.5, 1, 1.5, 2], label: words.seconds, text: (t) => decimal(t, 1) },
		{ range: [-1, 1], ticks: [-1, -0.5, 0, 0.5, 1], label: words.lengths, text: (value) => decimal(value, 1) },
	);
	const box = { x: x(0) - 6, y: y(1), width: x(SECONDS) - x(0) + 12, height: y(-1) - y(1) };
	const clipped = () => draw(svg, 'svg', { ...box, viewBox: `${box.x} ${box.y} ${box.width} ${box.height}` });
	return { x, y, clipped };
}

/** @returns the line that marks the present moment, and the scale of time */
export function drawRun(
	svg: SVGElement,
	width: number,
	height: number,
	{ spring, rate, exact, euler }: SpringRun,
	words: { seconds: string; lengths: string },
): { line: SVGElement; x: Scale } {
	const { x, y, clipped } = frame(svg, width, height, words);
	draw(svg, 'line', { class: 'rest', x1: x(0), x2: x(SECONDS), y1: y(spring.rest), y2: y(spring.rest) });
	const inside = clipped();
	const places = (way: readonly number[]) =>
		way.map((value, i) => [x(i / rate), y(Math.min(Math.max(value, -OUTSIDE), OUTSIDE))] as const);
	path(inside, places(euler), 'eigen');
	const times = Array.from({ length: CURVE_POINTS + 1 }, (_, i) => (i / CURVE_POINTS) * SECONDS);
	const curve = times.map((t) => [x(t), y(truth(spring, t))] as const);
	path(inside, curve, 'truth');
	const every = Math.ceil(MARKED / (x(1 / rate) - x(0)));
	for (const [points, shape, kind] of [
		[places(euler), 'square', 'eigen'],
		[places(exact), 'dot', 'ptm'],
	] as const)
		points.forEach(([px, py], i) => {
			if (i % every === 0) mark(inside, shape, kind, px, py, shape === 'dot' ? 4 : 3);
		});
	draw(svg, 'text', { class: 'value', x: x(SECONDS), y: y(spring.rest) - 9, 'text-anchor': 'end' }, 'xₑ');
	return { line: draw(svg, 'line', { class: 'now', y1: y(-1), y2: y(1) }), x };
}
