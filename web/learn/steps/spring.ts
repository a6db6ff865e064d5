/** The spring of each hair. Its exact step lies on the curve at any length, Euler's diverges. */

import { listenToDrags } from '../../scene/drag.ts';
import { action, controlRow, figureCanvas, note, slider } from '../controls.ts';
import { takeKeys } from '../drag.ts';
import type { Lesson, Mount } from '../lesson.ts';
import { decimal, legend, Plot, type Scale } from '../plot/plot.ts';
import { drawRun } from '../swing/drawRun.ts';
import { eulerLimit } from '../swing/oscillator.ts';
import { FIRST_RATE, SECONDS, SpringRun } from '../swing/SpringRun.ts';
import { drawTufts, MAX_DISPLACEMENT } from '../swing/tufts.ts';
import '../swing/style.css';

/** Time steps to choose from: 1 / so many seconds. */
const RATES = [240, 144, 120, 60, 45, 30, 20, 15, 10, 8, 5, 4, 3, 2];
/** Displacement per arrow key. */
const NUDGE = 0.1;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.spring;
	const run = new SpringRun();
	const tufts = drawnTufts(place, lesson, run);
	const plot = runPlot(place, lesson, run);
	const controls = controlRow(place);
	const says = note(place);
	const compute = () => {
		const off = run.compute();
		Object.assign(says.dataset, off);
		says.textContent = words.off(number(off.exact), number(off.euler), decimal(1000 * eulerLimit(run.spring), 0));
		plot.redraw();
		tufts.redraw();
	};
	const at = (moment: number) => {
		run.time = Math.min(Math.max(moment, 0), SECONDS);
		plot.point();
		tufts.redraw();
	};
	let playing = false;
	const letGo = () => {
		at(0);
		playing = true;
		lesson.painter.wake();
	};
	lesson.painter.animate((elapsed) => {
		if (!playing) return false;
		at(run.time + elapsed);
		playing = run.time < SECONDS;
		return playing;
	});
	/** Hold the hairs aside. */
	const hold = (x: number) => {
		playing = false;
		run.spring.from = Math.min(Math.max(x, -MAX_DISPLACEMENT), MAX_DISPLACEMENT);
		compute();
		at(0);
	};
	pullByHand(tufts.canvas, run, hold, letGo);
	sliders(controls, lesson, run, compute);
	action(controls, words.letGo, letGo);
	onceVisible(tufts.canvas, () => {
		if (!lesson.calm.on) letGo();
	});
};

/** Tufts bent by the solution, exact steps and Euler's steps, with their values. */
function drawnTufts(place: HTMLElement, { words, painter }: Lesson, run: SpringRun) {
	const canvas = figureCanvas(place, words.spring.tufts, 16 / 4.4);
	canvas.classList.add('tufts');
	const names = add(place, 'names');
	const values = words.spring.ways.map((name) => {
		const line = add(names, '', 'p');
		line.textContent = name;
		return add(line, '', 'strong');
	});
	const picture = painter.picture(canvas, () => {
		const tips = run.tips();
		drawTufts(canvas, tips);
		canvas.dataset.tips = tips.join();
		values.forEach((value, i) => {
			const text = number(tips[i] ?? 0);
			if (value.textContent !== text) value.textContent = text;
		});
	});
	return { canvas, redraw: () => picture.redraw() };
}

/** Plot with legend. `point` marks the present moment. */
function runPlot(place: HTMLElement, { words: { spring: words } }: Lesson, run: SpringRun) {
	let cursor: { line: SVGElement; x: Scale } | undefined;
	const point = () => {
		for (const end of ['x1', 'x2']) cursor?.line.setAttribute(end, String(cursor.x(run.time)));
	};
	const plot = new Plot(place, words.plot, 230, (svg, width, height) => {
		cursor = drawRun(svg, width, height, run, words);
		point();
	});
	legend(place, [
		['line', 'truth', words.ways[0] as string],
		['dot', 'ptm', words.ways[1] as string],
		['square', 'eigen', words.ways[2] as string],
	]);
	return { point, redraw: () => plot.redraw() };
}

/** Lets drags and arrow keys hold the hairs aside and let them go. */
function pullByHand(canvas: HTMLCanvasElement, { spring }: SpringRun, hold: (x: number) => void, letGo: () => void) {
	listenToDrags(
		canvas,
		({ x }) => {
			// Centre of the tuft under the finger.
			const middle = (Math.floor(((x + 1) / 2) * 3) + 0.5) / 1.5 - 1;
			hold(3 * (x - middle));
		},
		letGo,
	);
	takeKeys(canvas, (across, up) => {
		hold(spring.from + NUDGE * (across || up));
		letGo();
	});
}

function sliders(controls: HTMLElement, { words: { spring: words } }: Lesson, run: SpringRun, compute: () => void) {
	slider(controls, {
		label: words.step,
		min: 0,
		max: RATES.length - 1,
		step: 1,
		value: RATES.indexOf(FIRST_RATE),
		text: (i) => words.rate(RATES[i] ?? FIRST_RATE),
		input: (i) => {
			run.rate = RATES[i] ?? FIRST_RATE;
			compute();
		},
	});
	slider(controls, {
		label: words.frequency,
		min: 1,
		max: 6,
		step: 0.5,
		value: run.spring.frequency,
		text: (value) => words.hertz(decimal(value, 1)),
		input: (value) => {
			run.spring.frequency = value;
			compute();
		},
	});
	slider(controls, {
		label: words.damping,
		min: 0.05,
		max: 0.95,
		step: 0.05,
		value: run.spring.damping,
		text: (value) => decimal(value),
		input: (value) => {
			run.spring.damping = value;
			compute();
		},
	});
}

/** Calls back once when an element is first visible. */
function onceVisible(element: Element, act: () => void): void {
	const seen = new IntersectionObserver(
		([change]) => {
			if (!change?.isIntersecting) return;
			seen.disconnect();
			act();
		},
		{ threshold: 0.9 },
	);
	seen.observe(element);
}

function add(parent: Element, className = '', tag = 'div'): HTMLElement {
	const element = document.createElement(tag);
	if (className) element.className = className;
	parent.append(element);
	return element;
}

const RAISED = '⁰¹²³⁴⁵⁶⁷⁸⁹';

/** Number with two decimals, or as a power of ten if too large or small. */
export function number(value: number): string {
	const size = Math.abs(value);
	if (size === 0 || (size >= 0.005 && size < 1000)) return decimal(value);
	const power = Math.floor(Math.log10(size));
	const raised = [...String(Math.abs(power))].map((digit) => RAISED[Number(digit)]).join('');
	return `${decimal(value / 10 ** power, 1)} × 10${power < 0 ? '⁻' : ''}${raised}`;
}
