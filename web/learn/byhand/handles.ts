/** Plot with a parabola that hangs on three handles, which are dragged up and down or moved by keys. */

import { slideByKeys } from '../drag.ts';
import { type Axes, axes, decimal, draw, mark, Plot, line as path } from '../plot/plot.ts';
import type { Words } from '../words/index.ts';
import { type Parabola, type Point, parabolaOf, valueAt } from './parabola.ts';

/** Places of the handles on the axis. */
const PLACES = [-0.8, 0, 0.8];
/** Range of the axis, and pieces of a curve. */
const [END, PIECES] = [1.06, 60];
/** Change of a handle by one press of an arrow key, share of the range. */
const NUDGE = 1 / 50;
/** Radius of the area in which a handle is taken, pixels. */
const REACH = 22;

export class Handles {
	/** Heights of the three handles. */
	readonly heights = PLACES.map(() => 0);
	/** Second parabola beside the own one, if shown. */
	best: Parabola | undefined;
	#points: readonly Point[] = [];
	#lamp = 0;
	#top = 1;
	#update = (): void => {};
	/** Plot around them. */
	readonly plot: Plot;

	/** @param moved called after every move of a handle */
	constructor(
		place: Element,
		private readonly words: Words['hair'],
		private readonly moved: () => void,
	) {
		this.plot = new Plot(place, words.plot, 250, (svg, width, height) => this.#paint(svg, width, height));
		this.plot.svg.classList.add('handles');
		// Pictures hide what is in them from screen readers.
		this.plot.svg.setAttribute('role', 'group');
	}

	/** Own parabola, through the handles. */
	get parabola(): Parabola {
		return parabolaOf(PLACES.map((x, i) => [x, this.heights[i] ?? 0]));
	}

	/** Shows other measurements. @param top of the axis */
	measure(points: readonly Point[], top: number): void {
		[this.#points, this.#top] = [points, top];
		this.plot.redraw();
	}

	/** Marks the lamp's place on the axis. */
	point(lamp: number): void {
		this.#lamp = lamp;
		this.#update();
	}

	#paint(svg: SVGElement, width: number, height: number): void {
		const { words } = this;
		const ticks = Array.from({ length: Math.floor(this.#top) + 1 }, (_, i) => i);
		const scales = axes(
			svg,
			width,
			height,
			{ range: [-END, END], ticks: [-1, -0.5, 0, 0.5, 1], label: words.across, text: (value) => decimal(value, 1) },
			{ range: [0, this.#top], ticks, label: words.up },
		);
		const { x, y } = scales;
		const now = draw(svg, 'line', { class: 'now', y1: y(0), y2: y(this.#top) });
		if (this.best) path(svg, this.#curve(this.best, scales), 'eigen');
		path(svg, [], 'ptm');
		const own = svg.lastElementChild as SVGElement;
		for (const [px, py] of this.#points) mark(svg, 'ring', 'truth', x(px), y(py));
		const grips = PLACES.map((_, i) => this.#grip(svg, i, scales));
		this.#update = () => {
			for (const end of ['x1', 'x2']) now.setAttribute(end, String(x(this.#lamp)));
			const points = this.#curve(this.parabola, scales);
			own.setAttribute('d', points.map(([px, py], i) => `${i ? 'L' : 'M'}${px.toFixed(1)} ${py.toFixed(1)}`).join(''));
			for (const grip of grips) grip();
		};
		this.#update();
	}

	#curve(parabola: Parabola, { x, y }: Axes): [number, number][] {
		return Array.from({ length: PIECES + 1 }, (_, i) => {
			const at = (2 * i) / PIECES - 1;
			return [x(at), y(Math.min(Math.max(valueAt(parabola, at), 0), this.#top))];
		});
	}

	/** @returns function that moves its marks */
	#grip(svg: SVGElement, i: number, { x, y }: Axes): () => void {
		const { words } = this;
		const at = x(PLACES[i] ?? 0);
		const knob = draw(svg, 'circle', { class: 'knob', cx: at, r: 8 });
		const area = draw(svg, 'circle', {
			class: 'grip',
			cx: at,
			r: REACH,
			tabindex: 0,
			role: 'slider',
			'aria-label': words.handles[i] ?? '',
			'aria-orientation': 'vertical',
			'aria-valuemin': 0,
			'aria-valuemax': this.#top,
		});
		const put = (height: number) => {
			this.heights[i] = Math.min(Math.max(height, 0), this.#top);
			this.#update();
			this.moved();
		};
		area.addEventListener('pointerdown', (event) => {
			if (event.button === 0) area.setPointerCapture(event.pointerId);
		});
		area.addEventListener('pointermove', ({ pointerId, clientY }) => {
			if (!area.hasPointerCapture(pointerId)) return;
			put((this.#top * (clientY - svg.getBoundingClientRect().top - y(0))) / (y(this.#top) - y(0)));
		});
		slideByKeys(area, {
			least: 0,
			most: () => this.#top,
			step: () => NUDGE * this.#top,
			value: () => this.heights[i] ?? 0,
			put,
		});
		return () => {
			const height = this.heights[i] ?? 0;
			for (const circle of [knob, area]) circle.setAttribute('cy', String(y(height)));
			area.setAttribute('aria-valuenow', height.toFixed(2));
			area.setAttribute('aria-valuetext', `L = ${decimal(height)}`);
		};
	}
}
