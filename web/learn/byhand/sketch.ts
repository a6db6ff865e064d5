/** Sketch of fur from the side: hairs, the watched spot on one of them, and a lamp on its arc. */

import { random } from '../../page/random.ts';
import { css, type RGB } from '../plot/colours.ts';
import { draw } from '../plot/plot.ts';

/** Hairs of the sketch: number, and height as a share of the drawing's. */
const [HAIRS, TALL] = [34, 0.4];
/** Index of the watched hair, and height of the spot on it as a share of the hair. */
const [WATCHED, SPOT] = [17, 0.55];
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

/** @param angle of the lamp from upright, radians; @param colour of the spot */
export function drawSketch(svg: SVGElement, width: number, height: number, angle: number, colour: RGB): void {
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
		const watched = i === WATCHED;
		draw(svg, 'path', {
			class: watched ? 'hair watched' : 'hair',
			d: `M${root} ${arc.y}Q${bendX} ${bendY} ${tipX} ${tipY}`,
		});
		if (watched) spot = point(SPOT);
	}
	const [lampX, lampY] = [arc.x + arc.radius * Math.sin(angle), arc.y - arc.radius * Math.cos(angle)];
	const [spotX, spotY] = spot;
	draw(svg, 'line', { class: 'beam', x1: lampX, y1: lampY, x2: spotX, y2: spotY });
	draw(svg, 'circle', { class: 'spot', cx: spotX, cy: spotY, r: 8, fill: css(colour) });
	draw(svg, 'circle', { class: 'halo', cx: lampX, cy: lampY, r: 15 });
	draw(svg, 'circle', { class: 'bulb', cx: lampX, cy: lampY, r: 7 });
}
