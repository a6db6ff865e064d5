/** A texel's polynomial as a wire net over the disc of lights, and sticks from it to what was measured. */

import type { Direction } from '../../fur/index.ts';
import type { Chosen } from './chosen.ts';
import { decimal, draw, line, mark } from './plot.ts';
import { surfaceOf, type TexelState } from './texel.ts';

/** From how high it is seen, and turned about the upright axis. */
const TILT = (24 * Math.PI) / 180;
const TURN = (-28 * Math.PI) / 180;

/** Pixels. */
const MOST = 165;

const RINGS = [0.2, 0.4, 0.6, 0.8, 1];
const SPOKES = 24;

export function drawSurface(
	svg: SVGElement,
	width: number,
	height: number,
	state: TexelState,
	light: Direction,
	{ lamps, record }: Chosen,
): void {
	const { measured, exact } = state;
	const surface = surfaceOf(exact);
	const highest = Math.max(...measured, 0.2);
	const radius = Math.min((width - 40) / 2, MOST);
	const rise = (height - 46 - 2 * radius * Math.sin(TILT)) / highest;
	const base = height - 16 - radius * Math.sin(TILT);
	const at = (u: number, v: number, value: number): [number, number] => {
		const x = u * Math.cos(TURN) - v * Math.sin(TURN);
		const y = u * Math.sin(TURN) + v * Math.cos(TURN);
		return [width / 2 + radius * x, base - radius * y * Math.sin(TILT) - rise * value];
	};
	const circle = (out: number, value: (u: number, v: number) => number) =>
		Array.from({ length: 61 }, (_, i) => {
			const turn = (i / 30) * Math.PI;
			const [u, v] = [out * Math.cos(turn), out * Math.sin(turn)];
			return at(u, v, value(u, v));
		});

	line(
		svg,
		circle(1, () => 0),
		'rim',
	);
	for (const [u, v, name] of [
		[1, 0, 'lᵤ'],
		[0, 1, 'lᵥ'],
	] as const) {
		line(svg, [at(-u, -v, 0), at(u, v, 0)], 'grid');
		const [x, y] = at(1.09 * u, 1.09 * v, 0);
		draw(svg, 'text', { x, y: y + 4, 'text-anchor': 'middle' }, name);
	}
	for (const out of RINGS) line(svg, circle(out, surface), 'wire');
	for (let i = 0; i < SPOKES / 2; i++) {
		const turn = (i / (SPOKES / 2)) * Math.PI;
		const points = Array.from({ length: 21 }, (_, step) => {
			const out = step / 10 - 1;
			const [u, v] = [out * Math.cos(turn), out * Math.sin(turn)];
			return at(u, v, surface(u, v));
		});
		line(svg, points, 'wire');
	}

	// From behind to the front.
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
