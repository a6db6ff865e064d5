/** Texel's polynomial as colours over the disc of lights, with measurements as dots of the same colours. */

import type { Direction } from '../../fur/reference.ts';
import type { Selection } from '../data/Selection.ts';
import { surfaceOf, type TexelState } from '../data/texel.ts';
import { css, lightColour } from './colours.ts';

/** Pixels per side of the disc's image. */
const GRAIN = 96;

let ground: HTMLCanvasElement | undefined;

/** @param reach radius of the disc in halves of the canvas */
export function drawDisc(
	canvas: HTMLCanvasElement,
	state: TexelState,
	[lu, lv]: Direction,
	{ lamps, record }: Selection,
	reach: number,
): void {
	const context = canvas.getContext('2d');
	if (!context) return;
	const { width, height } = canvas;
	const half = width / 2;
	const radius = half * reach;
	context.clearRect(0, 0, width, height);
	context.save();
	context.beginPath();
	context.arc(half, half, radius, 0, 2 * Math.PI);
	context.clip();
	context.drawImage(paintGround(state, record.peak), half - radius, half - radius, 2 * radius, 2 * radius);
	context.restore();

	const { measured } = state;
	const size = half / 24;
	context.lineWidth = Math.max(half / 150, 1);
	lamps.forEach(([u, v], i) => {
		const [x, y] = [half + u * radius, half - v * radius];
		context.beginPath();
		if (i < record.fitted) context.arc(x, y, size, 0, 2 * Math.PI);
		else {
			const r = size * 1.35;
			context.moveTo(x, y - r);
			context.lineTo(x + r, y);
			context.lineTo(x, y + r);
			context.lineTo(x - r, y);
			context.closePath();
		}
		context.fillStyle = css(lightColour(measured[i] ?? 0, record.peak));
		context.fill();
		context.strokeStyle = i < record.fitted ? '#fff' : '#000';
		context.stroke();
	});

	drawCross(context, half + lu * radius, half - lv * radius, half);
}

/** The polynomial's colours over the square around the disc. */
function paintGround({ exact }: TexelState, peak: number): HTMLCanvasElement {
	ground ??= Object.assign(document.createElement('canvas'), { width: GRAIN, height: GRAIN });
	const image = new ImageData(GRAIN, GRAIN);
	const surface = surfaceOf(exact);
	for (let i = 0; i < GRAIN * GRAIN; i++) {
		const u = (((i % GRAIN) + 0.5) / GRAIN) * 2 - 1;
		const v = 1 - ((Math.floor(i / GRAIN) + 0.5) / GRAIN) * 2;
		const [r, g, b] = lightColour(surface(u, v), peak);
		image.data.set([r, g, b, 255], i * 4);
	}
	ground.getContext('2d')?.putImageData(image, 0, 0);
	return ground;
}

/** Cross in a ring where the light is. @param half of the canvas, pixels */
function drawCross(context: CanvasRenderingContext2D, x: number, y: number, half: number): void {
	const size = half / 24;
	for (const [colour, wide] of [
		['#000', 3.4],
		['#ffd9a0', 1.6],
	] as const) {
		context.strokeStyle = colour;
		context.lineWidth = (half / 150) * wide;
		context.beginPath();
		context.arc(x, y, size * 1.9, 0, 2 * Math.PI);
		context.moveTo(x - size * 3, y);
		context.lineTo(x + size * 3, y);
		context.moveTo(x, y - size * 3);
		context.lineTo(x, y + size * 3);
		context.stroke();
	}
}
