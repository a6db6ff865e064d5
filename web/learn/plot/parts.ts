/** Shared parts of these figures: choice of a layer, scale of colours, redraws. */

import { choice } from '../controls.ts';
import type { Selection } from '../data/Selection.ts';
import type { Lesson } from '../lesson.ts';
import { css, lightColour } from './colours.ts';
import { decimal } from './plot.ts';

/** Choice of a layer, the same in all figures. */
export function layerChoice(place: Element, lesson: Lesson, selection: Selection): void {
	const words = lesson.words.measured;
	const { samples, options } = selection.record;
	const labels = Object.fromEntries(samples.map(({ layer }, i) => [String(i), String(layer + 1)]));
	const set = choice(
		place,
		words.layerOf(options.layers),
		labels,
		String(selection.index),
		(index) => void selection.show(Number(index)),
	);
	selection.listen(() => {
		for (const input of set.querySelectorAll('input')) input.checked = input.value === String(selection.index);
	});
}

/** Scale of colours from dark to bright. */
export function ramp(place: Element, lesson: Lesson, peak: number): void {
	const words = lesson.words.measured;
	const row = document.createElement('p');
	row.className = 'ramp';
	const canvas = Object.assign(document.createElement('canvas'), { width: 140, height: 12 });
	canvas.setAttribute('aria-hidden', 'true');
	const context = canvas.getContext('2d');
	for (let x = 0; context && x < 140; x++) {
		context.fillStyle = css(lightColour(peak * (x / 139) ** 2, peak));
		context.fillRect(x, 0, 1, 12);
	}
	row.append(words.dark, canvas, `${words.bright} ${decimal(peak, 1)}`);
	place.append(row);
}

/**
 * Draws pictures when they come on screen, and again when the light or the choice changes.
 *
 * @param pictures canvases, each with the function that draws it
 * @returns function that redraws all of them
 */
export function live(
	lesson: Lesson,
	selection: Selection,
	pictures: readonly (readonly [HTMLCanvasElement, () => void])[],
): () => void {
	const entries = pictures.map(([canvas, draw]) => lesson.painter.picture(canvas, draw));
	const redraw = () => {
		for (const entry of entries) entry.redraw();
	};
	lesson.light.listen(redraw);
	selection.listen(redraw);
	return redraw;
}

/** Line of text, written only on change. */
export function line(place: Element, className = 'note'): (text: string) => void {
	const paragraph = document.createElement('p');
	paragraph.className = className;
	place.append(paragraph);
	return (text) => {
		if (paragraph.textContent !== text) paragraph.textContent = text;
	};
}
