/** Small line charts as SVG text, styled by the page's style sheet. */

import { count } from './tables.ts';

export interface Series {
	name: string;
	/** CSS class of its line and label. */
	kind: string;
	points: readonly (readonly [x: number, y: number])[];
}

export interface Axes {
	title: string;
	x: string;
	y: string;
	/** Marks of the horizontal axis, which reaches from the first to the last. */
	ticks: readonly number[];
	/** Whether the horizontal axis is logarithmic. */
	log?: boolean;
}

/** Size of the drawing, its own units. */
const WIDTH = 400;
const HEIGHT = 256;
const BOX = { left: 46, right: 300, top: 42, bottom: 210 };
/** Smallest distance between two labels. */
const LINE = 15;
const TICK = 34;

/** Round numbers from 0 to the first at or above `most`, three to six steps of 1, 2 or 5 times a power of ten. */
export function steps(most: number): number[] {
	if (!(most > 0)) return [0, 1];
	const power = 10 ** Math.floor(Math.log10(most / 3));
	const step = [1, 2, 5, 10].map((factor) => factor * power).find((size) => most / size <= 6) ?? most;
	const count = Math.ceil(most / step - 1e-9);
	return Array.from({ length: count + 1 }, (_, i) => Number((i * step).toPrecision(12)));
}

/** Positions near the wanted ones, in the same order, no two closer than `gap` and none below `lowest`. */
export function apart(wanted: readonly number[], gap: number, lowest: number): number[] {
	const order = [...wanted.keys()].sort((a, b) => (wanted[a] ?? 0) - (wanted[b] ?? 0));
	const places = [...wanted];
	let free = Number.NEGATIVE_INFINITY;
	for (const i of order) {
		places[i] = Math.max(wanted[i] ?? 0, free);
		free = (places[i] ?? 0) + gap;
	}
	let limit = lowest;
	for (const i of order.reverse()) {
		places[i] = Math.min(places[i] ?? 0, limit);
		limit = (places[i] ?? 0) - gap;
	}
	return places;
}

/** Ticks whose labels don't overlap: the last, and from there to the left. */
function legible(ticks: readonly number[], across: (tick: number) => number): number[] {
	let limit = Number.POSITIVE_INFINITY;
	return ticks.toReversed().filter((tick) => {
		if (across(tick) > limit) return false;
		limit = across(tick) - TICK;
		return true;
	});
}

const escaped = (text: string) => text.replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`);
const short = (value: number) => (value < 1000 ? String(Number(value.toPrecision(3))) : count(Math.round(value)));

/** @returns an `<svg>` element's text */
export function plot(series: readonly Series[], { title, x, y, ticks, log = false }: Axes): string {
	const { left, right, top, bottom } = BOX;
	const scale = (value: number) => (log ? Math.log(value) : value);
	const [first, last] = [scale(ticks[0] ?? 0), scale(ticks.at(-1) ?? 1)];
	const marks = steps(Math.max(...series.flatMap(({ points }) => points.map(([, value]) => value)), 0));
	const across = (value: number) => left + ((scale(value) - first) / (last - first || 1)) * (right - left);
	const up = (value: number) => bottom - (value / (marks.at(-1) ?? 1)) * (bottom - top);
	const at = (value: number) => value.toFixed(1);
	const text = (a: number, b: number, kind: string, words: string) =>
		`<text class="${kind}" x="${at(a)}" y="${at(b)}">${escaped(words)}</text>`;

	const names = apart(
		series.map(({ points }) => up(points.at(-1)?.[1] ?? 0)),
		LINE,
		bottom,
	);
	const summary = series.map(
		({ name, points }) => `${name} ${points.map(([a, b]) => `${short(a)}: ${short(b)}`).join(', ')}`,
	);
	return [
		`<svg class="plot" viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" aria-label="${escaped(`${title}. ${summary.join('; ')}`)}">`,
		text(0, 14, 'title', title),
		text(left, top - 8, 'unit', y),
		text(right, bottom + 34, 'unit end', x),
		...marks.map((mark) => `<path class="grid" d="M${left} ${at(up(mark))}H${right}"/>`),
		...marks.map((mark) => text(left - 7, up(mark) + 4, 'tick end', short(mark))),
		...legible(ticks, across).map((tick) => text(across(tick), bottom + 17, 'tick middle', short(tick))),
		...series.map(({ kind, points }) => {
			const path = points.map(([a, b]) => `${at(across(a))} ${at(up(b))}`).join('L');
			const dots = points.map(([a, b]) => `<circle cx="${at(across(a))}" cy="${at(up(b))}" r="3"/>`).join('');
			return `<g class="series ${kind}"><path d="M${path}"/>${dots}</g>`;
		}),
		...series.map(({ name, kind }, i) => text(right + 10, (names[i] ?? 0) + 4, `name ${kind}`, name)),
		'</svg>',
	].join('');
}
