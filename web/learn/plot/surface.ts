/** Texel's polynomial as a wire net over the disc of lights, with sticks to the measurements. */

import type { Direction } from '../../fur/reference.ts';
import type { Selection } from '../data/Selection.ts';
import { surfaceOf, type TexelState } from '../data/texel.ts';
import { decimal, draw, line, mark } from './plot.ts';

/** Elevation of the view, and turn about the upright axis. */
const TILT = (24 * Math.PI) / 180;
const TURN = (-28 * Math.PI) / 180;

/** Largest radius, pixels. */
const MAX_RADIUS = 165;

const RINGS = [0.2, 0.4, 0.6, 0.8, 1];
const SPOKES = 24;

/** Place in the picture of a value over the disc. */
type Project = (u: number, v: number, value: number) => [x: number, y: number];
type Surface = (u: number, v: number) => number;

export function drawSurface(
	svg: SVGElement,
	width: number,
	height: number,
	state: TexelState,
	light: Direction,
	{ lamps, record }: Selection,
): void {
	const { measured, exact } = state;
	const surface = surfaceOf(exact);
	const highest = Math.max(...measured, 0.2);
	const radius = Math.min((width - 40) / 2, MAX_RADIUS);
	const rise = (height - 46 - 2 * radius * Math.sin(TILT)) / highest;
	const base = height - 16 - radius * Math.sin(TILT);
	const at: Project = (u, v, value) => {
		const x = u * Math.cos(TURN) - v * Math.sin(TURN);
		const y = u * Math.sin(TURN) + v * Math.cos(TURN);
		return [width / 2 + radius * x, base - radius * y * Math.sin(TILT) - rise * value];
	};
	drawDiscBelow(svg, at);
	drawScale(svg, at, highest);
	drawNet(svg, at, surface);

	// Sort key from back to front.
	const depth = ([u, v]: Direction) => u * Math.sin(TURN) + v * Math.cos(TURN);
	const order = [...lamps.keys()].sort((a, b) => depth(lamps[b] ?? light) - depth(lamps[a] ?? light));
	for (const i of order) {
		const [u, v] = lamps[i] ?? light;
		const value = measured[i] ?? 0;
		const fitted = surface(u, v);
		const [from, to] = [at(u, v, fitted), at(u, v, value)];
		line(svg, [from, to], `stick ${value > fitted ? 'more' : 'less'}`);
		mark(svg, i < record.fitted ? 'dot' : 'diamond', 'truth', to[0], to[1], 2.6);
	}

	const [u, v] = light;
	const value = surface(u, v);
	const [foot, top] = [at(u, v, 0), at(u, v, value)];
	line(svg, [foot, top], 'now');
	mark(svg, 'ring', 'ptm', top[0], top[1], 5.5);
	draw(svg, 'text', { class: 'value', x: top[0] + 9, y: top[1] - 8 }, `L = ${decimal(value)}`);
}

/** Points of a ring. @param out its radius, 0..1 */
const ring = (out: number, at: Project, value: Surface) =>
	Array.from({ length: 61 }, (_, i) => {
		const turn = (i / 30) * Math.PI;
		const [u, v] = [out * Math.cos(turn), out * Math.sin(turn)];
		return at(u, v, value(u, v));
	});

/** Rim and axes of the disc of lights. */
function drawDiscBelow(svg: SVGElement, at: Project): void {
	const rim = ring(1, at, () => 0);
	line(svg, rim, 'rim');
	for (const [u, v, name] of [
		[1, 0, 'lᵤ'],
		[0, 1, 'lᵥ'],
	] as const) {
		line(svg, [at(-u, -v, 0), at(u, v, 0)], 'grid');
		const [x, y] = at(1.09 * u, 1.09 * v, 0);
		draw(svg, 'text', { class: 'name large', x, y: y + 5, 'text-anchor': 'middle' }, name);
	}
}

/** Upright axis of L over the rim's left end. @param highest value to be shown */
function drawScale(svg: SVGElement, at: Project, highest: number): void {
	const [u, v] = [-Math.cos(TURN), Math.sin(TURN)];
	line(svg, [at(u, v, 0), at(u, v, highest)], 'axis');
	for (let value = 0; value <= highest; value++) {
		const [x, y] = at(u, v, value);
		line(
			svg,
			[
				[x - 4, y],
				[x, y],
			],
			'axis',
		);
		draw(svg, 'text', { class: 'name', x: x - 7, y: y + 4, 'text-anchor': 'end' }, String(value));
	}
	const [x, y] = at(u, v, highest);
	draw(svg, 'text', { class: 'name large', x, y: y - 8, 'text-anchor': 'middle' }, 'L');
}

/** Rings and spokes of the polynomial. */
function drawNet(svg: SVGElement, at: Project, surface: Surface): void {
	for (const out of RINGS) line(svg, ring(out, at, surface), 'wire');
	for (let i = 0; i < SPOKES / 2; i++) {
		const turn = (i / (SPOKES / 2)) * Math.PI;
		const points = Array.from({ length: 21 }, (_, step) => {
			const out = step / 10 - 1;
			const [u, v] = [out * Math.cos(turn), out * Math.sin(turn)];
			return at(u, v, surface(u, v));
		});
		line(svg, points, 'wire');
	}
}
