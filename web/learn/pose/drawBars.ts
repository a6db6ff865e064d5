/** Six light moments as bars, before and after a turn. */

import { decimal, draw, scale } from '../plot/plot.ts';

/** Terms of the moments, in the order of the coefficients. */
export const TERMS = ['lᵤ²', 'lᵥ²', 'lᵤlᵥ', 'lᵤ', 'lᵥ', '1'] as const;

const [TOP, NAMES, NUMBERS] = [26, 40, 122];

/** @param words heads of both columns of numbers */
export function drawBars(
	svg: SVGElement,
	width: number,
	height: number,
	before: readonly number[],
	now: readonly number[],
	words: readonly [before: string, now: string],
): void {
	const room = (height - TOP) / TERMS.length;
	const x = scale([-1, 1], [NAMES, width - NUMBERS]);
	const columns = [width - 54, width] as const;
	words.forEach((word, i) => {
		draw(svg, 'text', { x: columns[i] as number, y: 13, 'text-anchor': 'end' }, word);
	});
	for (const value of [-1, 0, 1]) {
		draw(svg, 'line', { class: value ? 'grid' : 'axis', x1: x(value), x2: x(value), y1: TOP - 6, y2: height });
		draw(svg, 'text', { x: x(value), y: 13, 'text-anchor': 'middle' }, decimal(value, 0));
	}
	TERMS.forEach((term, i) => {
		const middle = TOP + (i + 0.5) * room;
		const bar = (value: number, half: number, kind: string) =>
			draw(svg, 'rect', {
				class: `bar ${kind}`,
				x: Math.min(x(0), x(value)),
				y: middle - half,
				width: Math.max(Math.abs(x(value) - x(0)), 1),
				height: 2 * half,
			});
		draw(svg, 'text', { class: 'name', x: 0, y: middle + 4 }, term);
		bar(before[i] ?? 0, 0.3 * room, 'was');
		bar(now[i] ?? 0, 0.15 * room, 'is');
		[before, now].forEach((moments, c) => {
			const at = { x: columns[c] as number, y: middle + 4, 'text-anchor': 'end', ...(c && { class: 'name' }) };
			draw(svg, 'text', at, decimal(moments[i] ?? 0));
		});
	});
}
