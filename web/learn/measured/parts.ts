/** What several of these figures have in common: the choice of a layer, the scale of colours, being drawn when it is time. */

import { choice } from '../controls.ts';
import type { Lesson } from '../lesson.ts';
import type { Chosen } from './chosen.ts';
import { css, lightColour } from './colours.ts';
import { decimal } from './plot.ts';
import { wordsIn } from './words.ts';

/** The same choice in all figures. */
export function layerChoice(place: Element, lesson: Lesson, chosen: Chosen): void {
	const words = wordsIn(lesson.language);
	const { samples, options } = chosen.record;
	const labels = Object.fromEntries(samples.map(({ layer }, i) => [String(i), String(layer + 1)]));
	const set = choice(
		place,
		words.layerOf(options.layers),
		labels,
		String(chosen.index),
		(index) => void chosen.show(Number(index)),
	);
	chosen.listen(() => {
		for (const input of set.querySelectorAll('input')) input.checked = input.value === String(chosen.index);
	});
}

/** From dark to bright, and what bright is. */
export function ramp(place: Element, lesson: Lesson, peak: number): void {
	const words = wordsIn(lesson.language);
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
 * Has pictures drawn when they come on screen, and anew when the light or what is looked at changes.
 *
 * @param pictures canvases, and what draws each of them and all that goes with it
 * @returns what has all of them drawn anew
 */
export function live(
	lesson: Lesson,
	chosen: Chosen,
	pictures: readonly (readonly [HTMLCanvasElement, () => void])[],
): () => void {
	const entries = pictures.map(([canvas, draw]) => lesson.painter.picture(canvas, draw));
	const redraw = () => {
		for (const entry of entries) entry.redraw();
	};
	lesson.light.listen(redraw);
	chosen.listen(redraw);
	return redraw;
}

/** A line of words that is written only when it changes. */
export function line(place: Element, className = 'note'): (text: string) => void {
	const paragraph = document.createElement('p');
	paragraph.className = className;
	place.append(paragraph);
	return (text) => {
		if (paragraph.textContent !== text) paragraph.textContent = text;
	};
}
