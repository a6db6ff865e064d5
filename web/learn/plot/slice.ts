/** Slices of fur as pictures: a colour per texel, clear without hair; v grows upwards. */

import './panels.css';
import { listenToDrags } from '../../scene/drag.ts';
import { figureCanvas, spoken } from '../controls.ts';
import type { Layer } from '../data/measurements.ts';
import type { Selection } from '../data/Selection.ts';
import { lightByKeys, takeKeys } from '../drag.ts';
import type { Lesson } from '../lesson.ts';
import type { MeasuredWords } from '../words/index.ts';
import type { RGB } from './colours.ts';

/** Coverage from which a texel is opaque; fainter ones are translucent. */
const WHOLE = 0.3;
const FAINTEST = 0.35;

const scratch = new Map<number, HTMLCanvasElement>();

function scratchOf(size: number): HTMLCanvasElement {
	let canvas = scratch.get(size);
	if (!canvas) {
		canvas = Object.assign(document.createElement('canvas'), { width: size, height: size });
		scratch.set(size, canvas);
	}
	return canvas;
}

/** Layer as a picture of one pixel per texel. @param colour of each texel with hair, by index */
export function sliceImage({ size, alpha, texels }: Layer, colour: (place: number) => RGB): HTMLCanvasElement {
	const canvas = scratchOf(size);
	const image = new ImageData(size, size);
	texels.forEach((texel, i) => {
		const at = ((size - 1 - Math.floor(texel / size)) * size + (texel % size)) * 4;
		const [r, g, b] = colour(i);
		const cover = Math.min((alpha[texel] ?? 0) / 255 / WHOLE, 1);
		image.data.set([r, g, b, 255 * (FAINTEST + (1 - FAINTEST) * cover)], at);
	});
	canvas.getContext('2d')?.putImageData(image, 0, 0);
	return canvas;
}

/** Fills a canvas with a layer. @param marked a texel with a frame around it */
export function drawSlice(
	canvas: HTMLCanvasElement,
	layer: Layer,
	colour: (place: number) => RGB,
	marked?: { row: number; column: number },
): void {
	const context = canvas.getContext('2d');
	if (!context) return;
	const { width, height } = canvas;
	context.clearRect(0, 0, width, height);
	context.imageSmoothingEnabled = false;
	context.drawImage(sliceImage(layer, colour), 0, 0, width, height);
	if (!marked) return;
	const [w, h] = [width / layer.size, height / layer.size];
	const around = Math.max(w, 7);
	const [x, y] = [(marked.column + 0.5) * w, (layer.size - marked.row - 0.5) * h];
	for (const [colourOf, line] of [
		['#000', 4],
		['#fff', 2],
	] as const) {
		context.strokeStyle = colourOf;
		context.lineWidth = (line * around) / 7 / 1.4;
		context.strokeRect(x - around, y - around, 2 * around, 2 * around);
	}
}

/** Square canvas with a caption. @returns the canvas, and a setter of the caption */
export function panel(place: Element, label: string): { canvas: HTMLCanvasElement; say: (text: string) => void } {
	const box = document.createElement('div');
	box.className = 'panel';
	place.append(box);
	const canvas = figureCanvas(box, label, 1);
	canvas.classList.add('slice');
	const words = document.createElement('p');
	words.textContent = label;
	box.append(words);
	return {
		canvas,
		say: (text) => {
			if (words.textContent !== text) words.textContent = text;
		},
	};
}

/** Row of panels that wraps. */
export function panels(place: Element, columns: 2 | 3): HTMLElement {
	const row = document.createElement('div');
	row.className = `panels of-${columns}`;
	place.append(row);
	return row;
}

/** Lets drags on a picture from above put the lamp over that place, and arrow keys turn it. */
export function lightFromAbove(canvas: HTMLCanvasElement, { light, words }: Lesson, reach = 1): void {
	canvas.classList.add('lit');
	canvas.setAttribute('aria-description', words.measured.moveLight);
	listenToDrags(canvas, ({ x, y }) => {
		const out = Math.hypot(x, y) / reach;
		const share = Math.min(out, 1) / Math.max(out, 1e-6) / reach;
		const [u, v] = [x * share, y * share];
		light.set(u, Math.sqrt(Math.max(1 - u * u - v * v, 0)), -v);
	});
	lightByKeys(canvas, light);
}

/** Lets pointers and arrow keys choose a texel on a slice; the one that keys have come to is spoken. */
export function texelByHand(canvas: HTMLCanvasElement, selection: Selection, { texelAt }: MeasuredWords): void {
	const say = spoken(canvas.parentElement as HTMLElement);
	canvas.classList.add('picked');
	listenToDrags(canvas, ({ x, y }) => {
		const { size } = selection.layer;
		selection.pick(((y + 1) / 2) * size - 0.5, ((x + 1) / 2) * size - 0.5);
	});
	takeKeys(canvas, (right, up) => {
		selection.step(right, up);
		say(texelAt(selection.column, selection.row));
	});
}
