/** One lamp over one hair, the curve of its light, and a parabola laid through it by hand. */

import { action, controlRow } from '../controls.ts';
import { toTile } from '../data/lights.ts';
import { Selection } from '../data/Selection.ts';
import { slideByKeys } from '../drag.ts';
import type { Lesson, Mount } from '../lesson.ts';
import { lightColour } from '../plot/colours.ts';
import { layerChoice, line } from '../plot/parts.ts';
import { decimal, Plot } from '../plot/plot.ts';
import { panels } from '../plot/slice.ts';
import { Handles } from './handles.ts';
import { errorOf, type Point, parabolaOf } from './parabola.ts';
import { angleAt, drawSketch, type Spot } from './sketch.ts';
import './style.css';

/** Largest angle of the lamp from upright, and the step of an arrow key, radians. */
const [MOST, STEP] = [(84 * Math.PI) / 180, (4 * Math.PI) / 180];
const DEGREES = 180 / Math.PI;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.hair;
	const selection = await Selection.of(lesson);
	const { record } = selection;
	const row = panels(place, 2);
	row.classList.add('byhand');
	const [left, right] = [document.createElement('div'), document.createElement('div')];
	row.append(left, right);

	const angle = () => {
		const [, lv, lz] = toTile(lesson.light.direction);
		return Math.min(Math.max(Math.atan2(lv, lz), -MOST), MOST);
	};
	const points = () => measuredArc(selection);
	const sketch = lampSketch(left, lesson, angle, () => {
		const [, value] = nearestPoint(points(), Math.sin(angle()));
		const height = (selection.layer.number + 0.5) / record.options.layers;
		return { height, colour: lightColour(value, record.peak) };
	});
	const says = line(right);
	const tell = () => {
		const own = errorOf(handles.parabola, points());
		const best = handles.best && errorOf(handles.best, points());
		place.dataset.own = String(own);
		says(
			words.says(
				handles.parabola.map((value) => decimal(value)),
				decimal(own),
				best === undefined ? '' : decimal(best),
			),
		);
	};
	const handles = new Handles(right, words, tell);
	right.append(right.firstElementChild as Element);
	const show = () => {
		const all = points();
		const top = Math.max(1, Math.ceil(Math.max(...all.map(([, value]) => value)) + 0.2));
		handles.best &&= parabolaOf(all);
		handles.measure(all, top);
		sketch();
		tell();
	};
	const controls = controlRow(place);
	const reveal = action(controls, words.best, () => {
		handles.best = handles.best ? undefined : parabolaOf(points());
		reveal.textContent = handles.best ? words.hide : words.best;
		show();
	});
	layerChoice(controls, lesson, selection);
	const mean = points().reduce((sum, [, value]) => sum + value / points().length, 0);
	handles.heights.fill(mean);
	show();
	selection.listen(show);
	lesson.light.listen(() => {
		sketch();
		handles.point(Math.sin(angle()));
	});
};

/** Light of the selected texel under the lamps of the arc, over their component along the skin. */
function measuredArc(selection: Selection): Point[] {
	const { lights, angles } = selection.record;
	const first = lights.length - angles.length;
	return angles.map((angle, i) => [Math.sin(angle / DEGREES), selection.measured(first + i)[selection.place] ?? 0]);
}

function nearestPoint(points: readonly Point[], x: number): Point {
	return points.reduce((best, point) => (Math.abs(point[0] - x) < Math.abs(best[0] - x) ? point : best), [9, 0]);
}

/** Sketch whose lamp is dragged along its arc. @returns function that redraws it */
function lampSketch(
	place: HTMLElement,
	{ light, words: { hair: words } }: Lesson,
	angle: () => number,
	spot: () => Spot,
): () => void {
	const plot = new Plot(place, words.sketch, 250, (svg, width, height) => {
		drawSketch(svg, width, height, angle(), spot());
		svg.setAttribute('aria-valuenow', (DEGREES * angle()).toFixed(0));
		svg.setAttribute('aria-valuetext', words.degrees(decimal(DEGREES * angle(), 0)));
	});
	const { svg } = plot;
	svg.classList.add('sketch');
	for (const [key, value] of Object.entries({ role: 'slider', tabindex: 0, 'aria-valuemin': -84, 'aria-valuemax': 84 }))
		svg.setAttribute(key, String(value));
	const put = (to: number) => light.set(0, Math.cos(to), -Math.sin(to));
	const follow = ({ clientX, clientY }: PointerEvent) => {
		const { left, top, width, height } = svg.getBoundingClientRect();
		put(angleAt(clientX - left, clientY - top, width, height, MOST));
	};
	svg.addEventListener('pointerdown', (event) => {
		if (event.button !== 0) return;
		svg.setPointerCapture(event.pointerId);
		follow(event);
	});
	svg.addEventListener('pointermove', (event) => {
		if (svg.hasPointerCapture(event.pointerId)) follow(event);
	});
	slideByKeys(svg, { least: -MOST, most: () => MOST, step: () => STEP, value: angle, put });
	return () => plot.redraw();
}
