/** Step 10: the spring that each hair is on. Its exact step lies on the curve at any length, Euler's flies off. */

import { action, controlRow, figureCanvas, note, slider } from '../controls.ts';
import { arrows, listenToDrags } from '../drag.ts';
import type { Mount } from '../lesson.ts';
import { axes, decimal, draw, legend, mark, Plot, line as path, type Scale } from '../measured/plot.ts';
import { eulerLimit, eulerPath, exactPath, farthest, type Oscillator, truth } from '../swing/oscillator.ts';
import { drawTufts, FARTHEST } from '../swing/tufts.ts';
import '../swing/style.css';

/** Of the time axis. */
const SECONDS = 2;
/** Time steps to choose from: 1 / so many seconds. */
const RATES = [240, 144, 120, 60, 45, 30, 20, 15, 10, 8, 5, 4, 3, 2];
const FIRST_RATE = 60;
/** Where Euler's path has long left the picture. */
const OUTSIDE = 50;
/** Pixels between marks: of shorter steps not every one has a mark. */
const MARKED = 8;
const CURVE_POINTS = 400;
/** Displacement by an arrow key. */
const NUDGE = 0.1;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.spring;
	const spring: Oscillator = { frequency: 3, damping: 0.15, rest: 0.1, from: 0.7 };
	let rate = FIRST_RATE;
	/** Seconds since it was let go. */
	let time = 0.3;
	let playing = false;
	let exact: number[] = [];
	let euler: number[] = [];

	const canvas = figureCanvas(place, words.tufts, 16 / 4.4);
	canvas.classList.add('tufts');
	const names = add(place, 'names');
	const values = words.ways.map((name) => {
		const line = add(names, '', 'p');
		line.textContent = name;
		return add(line, '', 'strong');
	});

	let cursor: { line: SVGElement; x: Scale } | undefined;
	const plot = new Plot(place, words.plot, 280, (svg, width, height) => {
		const { x, y } = axes(
			svg,
			width,
			height,
			{ range: [0, SECONDS], ticks: [0, 0.5, 1, 1.5, 2], label: words.seconds, text: (t) => decimal(t, 1) },
			{ range: [-1, 1], ticks: [-1, -0.5, 0, 0.5, 1], label: words.lengths, text: (value) => decimal(value, 1) },
		);
		draw(svg, 'line', { class: 'rest', x1: x(0), x2: x(SECONDS), y1: y(spring.rest), y2: y(spring.rest) });
		// What leaves the picture is cut off at its edge.
		const frame = { x: x(0) - 6, y: y(1), width: x(SECONDS) - x(0) + 12, height: y(-1) - y(1) };
		const inside = draw(svg, 'svg', { ...frame, viewBox: `${frame.x} ${frame.y} ${frame.width} ${frame.height}` });
		const places = (way: readonly number[]) =>
			way.map((value, i) => [x(i / rate), y(Math.min(Math.max(value, -OUTSIDE), OUTSIDE))] as const);
		const marks = places(exact);
		path(inside, places(euler), 'eigen');
		const curve = Array.from({ length: CURVE_POINTS + 1 }, (_, i) => (i / CURVE_POINTS) * SECONDS);
		path(
			inside,
			curve.map((t) => [x(t), y(truth(spring, t))] as const),
			'truth',
		);
		const every = Math.ceil(MARKED / (x(1 / rate) - x(0)));
		for (const [points, shape, kind] of [
			[places(euler), 'square', 'eigen'],
			[marks, 'dot', 'ptm'],
		] as const)
			points.forEach(([px, py], i) => {
				if (i % every === 0) mark(inside, shape, kind, px, py, shape === 'dot' ? 4 : 3);
			});
		draw(svg, 'text', { class: 'value', x: x(SECONDS), y: y(spring.rest) - 9, 'text-anchor': 'end' }, 'xₑ');
		cursor = { line: draw(svg, 'line', { class: 'now', y1: y(-1), y2: y(1) }), x };
		point();
	});
	legend(place, [
		['line', 'truth', words.ways[0] as string],
		['dot', 'ptm', words.ways[1] as string],
		['square', 'eigen', words.ways[2] as string],
	]);

	const picture = lesson.painter.picture(canvas, () => {
		const step = Math.floor(time * rate + 1e-6);
		const tips = [truth(spring, time), exact[step] ?? exact.at(-1) ?? 0, euler[step] ?? euler.at(-1) ?? 0];
		drawTufts(canvas, tips);
		canvas.dataset.tips = tips.join();
		values.forEach((value, i) => {
			const text = number(tips[i] ?? 0);
			if (value.textContent !== text) value.textContent = text;
		});
	});
	/** The plot's own line at this moment. */
	function point() {
		for (const end of ['x1', 'x2']) cursor?.line.setAttribute(end, String(cursor.x(time)));
	}
	const at = (moment: number) => {
		time = Math.min(Math.max(moment, 0), SECONDS);
		point();
		picture.redraw();
	};

	const controls = controlRow(place);
	const says = note(place);
	const compute = () => {
		const dt = 1 / rate;
		exact = exactPath(spring, dt, SECONDS);
		euler = eulerPath(spring, dt, SECONDS);
		const off = { exact: farthest(exact, spring, dt), euler: farthest(euler, spring, dt) };
		Object.assign(says.dataset, off);
		says.textContent = words.off(number(off.exact), number(off.euler), decimal(1000 * eulerLimit(spring), 0));
		plot.redraw();
		picture.redraw();
	};
	const letGo = () => {
		at(0);
		playing = true;
		lesson.painter.wake();
	};
	lesson.painter.animate((elapsed) => {
		if (!playing) return false;
		at(time + elapsed);
		playing = time < SECONDS;
		return playing;
	});

	/** Holds the hairs aside. */
	const hold = (x: number) => {
		playing = false;
		spring.from = Math.min(Math.max(x, -FARTHEST), FARTHEST);
		compute();
		at(0);
	};
	listenToDrags(
		canvas,
		({ x }) => {
			// The middle of the tuft under the finger.
			const middle = (Math.floor(((x + 1) / 2) * 3) + 0.5) / 1.5 - 1;
			hold(3 * (x - middle));
		},
		letGo,
	);
	arrows(canvas, (across, up) => {
		hold(spring.from + NUDGE * (across || up));
		letGo();
	});

	slider(controls, {
		label: words.step,
		min: 0,
		max: RATES.length - 1,
		step: 1,
		value: RATES.indexOf(FIRST_RATE),
		text: (i) => words.rate(RATES[i] ?? FIRST_RATE),
		input: (i) => {
			rate = RATES[i] ?? FIRST_RATE;
			compute();
		},
	});
	slider(controls, {
		label: words.frequency,
		min: 1,
		max: 6,
		step: 0.5,
		value: spring.frequency,
		text: (value) => words.hertz(decimal(value, 1)),
		input: (value) => {
			spring.frequency = value;
			compute();
		},
	});
	slider(controls, {
		label: words.damping,
		min: 0.05,
		max: 0.95,
		step: 0.05,
		value: spring.damping,
		text: (value) => decimal(value),
		input: (value) => {
			spring.damping = value;
			compute();
		},
	});
	action(controls, words.letGo, letGo);
	if (lesson.calm) return;
	// Once by itself, when it is seen.
	const seen = new IntersectionObserver(
		([change]) => {
			if (!change?.isIntersecting) return;
			seen.disconnect();
			letGo();
		},
		{ threshold: 0.9 },
	);
	seen.observe(canvas);
};

function add(parent: Element, className = '', tag = 'div'): HTMLElement {
	const element = document.createElement(tag);
	if (className) element.className = className;
	parent.append(element);
	return element;
}

const RAISED = '⁰¹²³⁴⁵⁶⁷⁸⁹';

/** Two decimals, or powers of ten where those say nothing. */
export function number(value: number): string {
	const size = Math.abs(value);
	if (size === 0 || (size >= 0.005 && size < 1000)) return decimal(value);
	const power = Math.floor(Math.log10(size));
	const raised = [...String(Math.abs(power))].map((digit) => RAISED[Number(digit)]).join('');
	return `${decimal(value / 10 ** power, 1)} × 10${power < 0 ? '⁻' : ''}${raised}`;
}
