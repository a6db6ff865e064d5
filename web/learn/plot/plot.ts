/** SVG plots: as wide as their place, with text of one size and colours from the style sheet. */

import './plot.css';

export type Attributes = Readonly<Record<string, string | number>>;

const SVG = 'http://www.w3.org/2000/svg';

/** Adds an element to another. */
export function draw(parent: Element, name: string, attributes: Attributes, text?: string): SVGElement {
	const element = document.createElementNS(SVG, name);
	for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
	if (text !== undefined) element.textContent = text;
	parent.append(element);
	return element;
}

/** Number to some decimals, with a true minus. */
export function decimal(value: number, digits = 2): string {
	const text = value.toFixed(digits);
	return Number(text) === 0 ? text.replace('-', '') : text.replace('-', '−');
}

/** Drawing that is redone when its width or content changes. */
export class Plot {
	readonly svg: SVGElement;
	#width = 0;

	/** @param paint fills the emptied drawing; units are pixels */
	constructor(
		place: Element,
		label: string,
		readonly height: number,
		private readonly paint: (svg: SVGElement, width: number, height: number) => void,
	) {
		this.svg = draw(place, 'svg', { class: 'plot', role: 'img', 'aria-label': label, height });
		new ResizeObserver(() => {
			const width = Math.round(this.svg.getBoundingClientRect().width);
			if (!width || width === this.#width) return;
			this.#width = width;
			this.redraw();
		}).observe(this.svg);
	}

	redraw(): void {
		if (!this.#width) return;
		this.svg.setAttribute('viewBox', `0 0 ${this.#width} ${this.height}`);
		this.svg.replaceChildren();
		this.paint(this.svg, this.#width, this.height);
	}
}

/** Position of a number on an axis. */
export type Scale = (value: number) => number;

export function scale(from: readonly [number, number], to: readonly [number, number]): Scale {
	return (value) => to[0] + ((value - from[0]) / (from[1] - from[0])) * (to[1] - to[0]);
}

export interface Axes {
	x: Scale;
	y: Scale;
}

export interface AxisOptions {
	range: readonly [number, number];
	ticks: readonly number[];
	label: string;
	text?: (value: number) => string;
}

const MARGIN = { left: 40, right: 14, top: 24, bottom: 40 };

/** Draws lines, numbers and names of both axes. @returns scales of both */
export function axes(svg: SVGElement, width: number, height: number, across: AxisOptions, up: AxisOptions): Axes {
	const { left, right, top, bottom } = MARGIN;
	const x = scale(across.range, [left, width - right]);
	const y = scale(up.range, [height - bottom, top]);
	for (const tick of up.ticks) {
		draw(svg, 'line', { class: 'grid', x1: left, x2: width - right, y1: y(tick), y2: y(tick) });
		const text = up.text?.(tick) ?? String(tick);
		draw(svg, 'text', { x: left - 6, y: y(tick) + 4, 'text-anchor': 'end' }, text);
	}
	for (const tick of across.ticks) {
		const text = across.text?.(tick) ?? String(tick);
		draw(svg, 'text', { x: x(tick), y: height - bottom + 17, 'text-anchor': 'middle' }, text);
	}
	draw(svg, 'line', { class: 'axis', x1: left, x2: width - right, y1: height - bottom, y2: height - bottom });
	draw(svg, 'text', { class: 'name', x: 2, y: 13 }, up.label);
	draw(svg, 'text', { class: 'name', x: width - right, y: height - 5, 'text-anchor': 'end' }, across.label);
	return { x, y };
}

/** Line through points. */
export function line(svg: Element, points: readonly (readonly [number, number])[], kind: string): void {
	const d = points.map(([x, y], i) => `${i ? 'L' : 'M'}${x.toFixed(1)} ${y.toFixed(1)}`).join('');
	draw(svg, 'path', { class: kind, d });
}

export type Mark = 'dot' | 'ring' | 'square' | 'diamond';

/** Mark with its own shape, so that nothing is told by colour alone. */
export function mark(svg: Element, shape: Mark, kind: string, x: number, y: number, size = 4): SVGElement {
	const className = `mark ${shape} ${kind}`;
	if (shape === 'square')
		return draw(svg, 'rect', { class: className, x: x - size, y: y - size, width: 2 * size, height: 2 * size });
	if (shape === 'diamond') {
		const r = size * 1.4;
		return draw(svg, 'path', { class: className, d: `M${x} ${y - r}L${x + r} ${y}L${x} ${y + r}L${x - r} ${y}Z` });
	}
	return draw(svg, 'circle', { class: className, cx: x, cy: y, r: size });
}

/** Legend of marks, as a wrapping row of the page. */
export function legend(place: Element, entries: readonly (readonly [Mark | 'line', string, string])[]): void {
	const row = document.createElement('p');
	row.className = 'legend';
	place.append(row);
	for (const [shape, kind, text] of entries) {
		const entry = document.createElement('span');
		const svg = draw(entry, 'svg', { class: 'plot', width: 22, height: 14, 'aria-hidden': 'true' });
		if (shape === 'line')
			line(
				svg,
				[
					[1, 7],
					[21, 7],
				],
				kind,
			);
		else mark(svg, shape, kind, 11, 7);
		entry.append(text);
		row.append(entry);
	}
}
