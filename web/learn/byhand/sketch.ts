/** Sketch of fur from the side: hairs, the watched spot on one of them, and a lamp on its arc. */

import { random } from '../../page/random.ts';
import { css, type RGB } from '../plot/colours.ts';
import { draw } from '../plot/plot.ts';

/** Hairs of the sketch: number, and height as a share of the drawing's. */
const [HAIRS, TALL] = [34, 0.4];
/** Index of the watched hair. */
const WATCHED = 17;
const GROUND = 14;
/** Space above and beside the lamp's arc. */
const ROOM = 20;

/** Centre and radius of the lamp's arc. */
export function arcOf(width: number, height: number): { x: number; y: number; radius: number } {
	return { x: width / 2, y: height - GROUND, radius: Math.min(width / 2 - ROOM, height - GROUND - ROOM) };
}

/** Angle of a place on the drawing from upright, radians, at most `most` to either side. */
export function angleAt(x: number, y: number, width: number, height: number, most: number): number {
	const arc = arcOf(width, height);
	const angle = Math.atan2(x - arc.x, Math.max(arc.y - y, 1e-6));
	return Math.min(Math.max(angle, -most), most);
}

/** Watched spot: its height as a share of the hair, and its colour. */
export interface Spot {
	height: number;
	colour: RGB;
}

/** @param angle of the lamp from upright, radians; @param watched spot on the hair */
export function drawSketch(svg: SVGElement, width: number, height: number, angle: number, watched: Spot): void {
	const arc = arcOf(width, height);
	const [left, right] = [arc.x - arc.radius, arc.x + arc.radius];
	draw(svg, 'path', { class: 'arc', d: `M${left} ${arc.y}A${arc.radius} ${arc.radius} 0 0 1 ${right} ${arc.y}` });
	draw(svg, 'line', { class: 'skin', x1: left, x2: right, y1: arc.y, y2: arc.y });
	const next = random(7);
	const tall = TALL * height;
	let spot = [arc.x, arc.y] as const;
	for (let i = 0; i < HAIRS; i++) {
		const root = arc.x + ((i - WATCHED) / HAIRS) * 1.7 * arc.radius + (next() - 0.5) * 8;
		const [lean, up] = [(next() - 0.2) * tall * 0.5, tall * (0.7 + 0.3 * next())];
		const point = (t: number) => [root + lean * t * t, arc.y - up * t] as const;
		const [bendX, bendY] = [root, arc.y - up / 2];
		const [tipX, tipY] = point(1);
		draw(svg, 'path', {
			class: i === WATCHED ? 'hair watched' : 'hair',
			d: `M${root} ${arc.y}Q${bendX} ${bendY} ${tipX} ${tipY}`,
		});
		if (i === WATCHED) spot = point(watched.height);
	}
	const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
	const [lampX, lampY] = [arc.x + arc.radius * sin, arc.y - arc.radius * cos];
	const [spotX, spotY] = spot;
	// The lamp is far away: its rays are parallel, drawn from one front on.
	for (const [x, y, kind] of [
		[arc.x, arc.y, 'beam aside'],
		[spotX, spotY, 'beam'],
	] as const) {
		const long = (lampX - x) * sin - (lampY - y) * cos;
		draw(svg, 'line', { class: kind, x1: x + long * sin, y1: y - long * cos, x2: x, y2: y });
	}
	draw(svg, 'circle', { class: 'spot', cx: spotX, cy: spotY, r: 8, fill: css(watched.colour) });
	draw(svg, 'circle', { class: 'halo', cx: lampX, cy: lampY, r: 15 });
	draw(svg, 'circle', { class: 'bulb', cx: lampX, cy: lampY, r: 7 });
}
