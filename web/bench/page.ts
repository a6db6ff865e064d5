/** Elements of the report. */

import type { MethodPicture } from '../measure/bench/measure.ts';
import type { Section } from './report.ts';
import { type Table, titleOf } from './tables.ts';
import type { Words } from './words/en.ts';

/** Linear colour behind fur in pictures. */
const BACKDROP = [0.024, 0.037, 0.053];

function element<K extends keyof HTMLElementTagNameMap>(
	name: K,
	text = '',
	...children: (HTMLElement | SVGElement)[]
): HTMLElementTagNameMap[K] {
	const made = document.createElement(name);
	made.append(text, ...children);
	return made;
}

function tableElement({ caption, head, rows }: Table): HTMLElement {
	const row = (cells: string[], heading: boolean) =>
		element(
			'tr',
			'',
			...cells.map((cell, i) => {
				// An empty corner heads nothing.
				const made = element((heading || i === 0) && cell ? 'th' : 'td', cell);
				if (made.localName === 'th') made.setAttribute('scope', heading ? 'col' : 'row');
				return made;
			}),
		);
	const table = element(
		'table',
		'',
		element('thead', '', row(head, true)),
		element('tbody', '', ...rows.map((cells) => row(cells, false))),
	);
	table.prepend(element('caption', caption));
	// Wide tables scroll on their own, also by keyboard.
	const frame = element('div', '', table);
	frame.className = 'scroll';
	frame.tabIndex = 0;
	frame.setAttribute('role', 'group');
	frame.setAttribute('aria-label', caption);
	return frame;
}

export function sectionElement({ title, text, tables, plots }: Section): HTMLElement {
	const drawings = element('div');
	drawings.className = 'plots';
	drawings.innerHTML = plots.join('');
	return element(
		'section',
		'',
		element('h2', title),
		element('p', text),
		...tables.map((table) => tableElement(table)),
		...(plots.length ? [drawings] : []),
	);
}

/** Pictures side by side, each with its method's name. */
export function gallery(methodPictures: readonly MethodPicture[], words: Words): HTMLElement {
	const made = element('div', '', ...methodPictures.map((picture) => figureElement(picture, words)));
	made.className = 'gallery';
	return made;
}

function figureElement({ row, width, height, rgba }: MethodPicture, words: Words): HTMLElement {
	const name = titleOf(row, words);
	const canvas = element('canvas');
	Object.assign(canvas, { width, height });
	canvas.getContext('2d')?.putImageData(new ImageData(toBytes(rgba, width, height), width, height), 0, 0);
	canvas.setAttribute('role', 'img');
	canvas.setAttribute('aria-label', words.picture(name));
	return element('figure', '', canvas, element('figcaption', name));
}

/** sRGB bytes over the backdrop, row by row from the top. */
function toBytes(rgba: Float32Array, width: number, height: number): Uint8ClampedArray<ArrayBuffer> {
	const bytes = new Uint8ClampedArray(width * height * 4).fill(255);
	for (let i = 0; i < width * height; i++) {
		const from = 4 * ((height - 1 - Math.floor(i / width)) * width + (i % width));
		for (let c = 0; c < 3; c++) {
			const linear = (rgba[from + c] ?? 0) + (1 - (rgba[from + 3] ?? 0)) * (BACKDROP[c] ?? 0);
			bytes[4 * i + c] = 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
		}
	}
	return bytes;
}
