/** Polar plots of the factor of light and eye: once around the fur, seen from above, and over it from horizon to horizon. */

import './style.css';
import { decimal, draw, line, mark } from '../plot/plot.ts';

/** Smallest value at the rim. */
const LEAST_RIM = 2;
/** Room for marks around the rim, pixels. */
const AROUND = 20;
/** Step of the curves, degrees. */
const STEP = 1;
/** Radius of marks beyond the rim, share of the rim's. */
const OUTSIDE = 1.07;

const radians = (degrees: number) => (degrees * Math.PI) / 180;

/** Content of a plot. Angles are degrees, anticlockwise from the right. */
export interface Polar {
	/** G of an eye at this angle. */
	factor: (angle: number) => number;
	eye: number;
	light: number;
	/** Direction of the hairs' tips, and their displacement, 0..1. */
	lean: readonly [angle: number, share: number];
}

interface Disc {
	svg: SVGElement;
	/** Value at the rim, a whole number. */
	rim: number;
	at: (angle: number, factor: number) => [number, number];
}

/** Value at the rim of a plot that has room for every point of its curve. */
export function rimFor({ factor }: Polar, from: number, to: number): number {
	return Math.max(LEAST_RIM, ...anglesOf(from, to).map((angle) => Math.ceil(factor(angle))));
}

const anglesOf = (from: number, to: number) =>
	Array.from({ length: Math.ceil((to - from) / STEP) + 1 }, (_, i) => Math.min(from + i * STEP, to));

const rings = (rim: number) => Array.from({ length: rim }, (_, i) => i + 1);

/** Draws the factor around the fur, seen from above. */
export function drawAround(svg: SVGElement, width: number, height: number, shown: Polar): void {
	const radius = Math.min(width, height) / 2 - AROUND;
	const disc = discAt(svg, width / 2, height / 2, radius, rimFor(shown, 0, 360));
	for (const ring of rings(disc.rim))
		draw(svg, 'circle', {
			class: ring === 1 ? 'one' : 'grid',
			cx: width / 2,
			cy: height / 2,
			r: (ring / disc.rim) * radius,
		});
	labels(disc, clear([shown.eye, shown.light]));
	const [x, y] = disc.at(shown.lean[0], 0.21 * disc.rim);
	const [fromX, fromY] = disc.at(shown.lean[0] + 180, 0.21 * disc.rim);
	draw(svg, 'path', { class: 'lean', d: `M${fromX} ${fromY}L${x} ${y}` });
	draw(svg, 'path', {
		class: 'tip',
		d: 'M0 0L-11 -5L-11 5Z',
		transform: `translate(${x} ${y}) rotate(${-shown.lean[0]})`,
	});
	curve(disc, shown, 0, 360);
	marks(disc, shown);
}

/** Draws the factor over the fur, in a vertical section from horizon to horizon. @param lowest angle of an eye */
export function drawOver(svg: SVGElement, width: number, height: number, shown: Polar, lowest: number): void {
	const radius = Math.min(width / 2, height) - AROUND;
	const [cx, cy] = [width / 2, (height + radius) / 2];
	const disc = discAt(svg, cx, cy, radius, rimFor(shown, lowest, 180 - lowest));
	for (const ring of rings(disc.rim)) {
		const r = (ring / disc.rim) * radius;
		draw(svg, 'path', { class: ring === 1 ? 'one' : 'grid', d: `M${cx - r} ${cy}A${r} ${r} 0 0 1 ${cx + r} ${cy}` });
	}
	labels(disc, 0);
	draw(svg, 'line', { class: 'axis', x1: cx - radius, x2: cx + radius, y1: cy, y2: cy });
	const reach = 0.14 * radius;
	const aside = shown.lean[1] * Math.cos(radians(shown.lean[0]));
	for (let i = -3; i <= 3; i++) {
		const x = cx + (i * reach) / 2;
		draw(svg, 'path', { class: 'lean', d: `M${x} ${cy}q0 ${-reach / 2} ${aside * reach} ${-reach}` });
	}
	curve(disc, shown, lowest, 180 - lowest);
	marks(disc, shown);
}

function discAt(svg: SVGElement, cx: number, cy: number, radius: number, rim: number): Disc {
	const at = (angle: number, factor: number): [number, number] => {
		const out = (factor / rim) * radius;
		return [cx + out * Math.cos(radians(angle)), cy - out * Math.sin(radians(angle))];
	};
	return { svg, rim, at };
}

/** Diagonal that is farthest from all of these angles. */
function clear(angles: readonly number[]): number {
	const apart = (diagonal: number) => Math.min(...angles.map((angle) => -Math.cos(radians(angle - diagonal))));
	return [45, 135, 225, 315].reduce((best, diagonal) => (apart(diagonal) > apart(best) ? diagonal : best));
}

/** Draw the rings' values, outside of them; below the axis at 0°. */
function labels({ svg, rim, at }: Disc, angle: number): void {
	for (const ring of rings(rim)) {
		const [x, y] = at(angle, ring);
		const left = Math.cos(radians(angle)) < 0;
		const below = Math.sin(radians(angle)) <= 0;
		const text = { x: x + (left ? -3 : 3), y: y + (below ? 14 : -3), 'text-anchor': left ? 'end' : 'start' };
		draw(svg, 'text', text, String(ring));
	}
}

function curve({ svg, at }: Disc, { factor }: Polar, from: number, to: number): void {
	line(
		svg,
		anglesOf(from, to).map((angle) => at(angle, factor(angle))),
		'ptm',
	);
}

/** Draw lamp and eye on the rim, and the curve's point under the eye. */
function marks({ svg, rim, at }: Disc, { factor, eye, light }: Polar): void {
	for (const [angle, kind, shape, size] of [
		[light, 'bulb', 'dot', 5],
		[eye, 'watcher', 'ring', 9],
	] as const) {
		const [x0, y0] = at(angle, 0);
		const [x1, y1] = at(angle, OUTSIDE * rim);
		draw(svg, 'line', { class: `ray ${kind}`, x1: x0, y1: y0, x2: x1, y2: y1 });
		mark(svg, shape, kind, x1, y1, size);
	}
	const now = factor(eye);
	const [x, y] = at(eye, now);
	mark(svg, 'dot', 'watcher', x, y, 5);
	const right = Math.cos(radians(eye)) > 0;
	const text = { class: 'value', x: x + (right ? -9 : 9), y: y - 9, 'text-anchor': right ? 'end' : 'start' };
	draw(svg, 'text', text, decimal(now));
}
