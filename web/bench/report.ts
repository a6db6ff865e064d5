/** Report: sections of tables and plots for the figures so far. */

import { ARTICLE, type BenchFigures, type Point, type Result } from '../measure/bench/results.ts';
import { plot, type Series } from './plot.ts';
import { articleTable, cardTable, costTable, count, methodTable, overdrawTable, type Table, times } from './tables.ts';
import type { Words } from './words/en.ts';

export interface Section {
	title: string;
	/** Paragraph below the title. */
	text: string;
	tables: Table[];
	/** SVG text. */
	plots: string[];
}

/** Methods in the plots. */
const LINES: Result['method'][] = ['shadow-layers', 'ptm', 'unlit'];

export function sections(figures: BenchFigures, words: Words): Section[] {
	const { results, results_of_layers, costs, lights, curves, card } = figures;
	const found: Section[] = [];
	const add = (title: string, text: string, tables: Table[], plots: string[] = []) =>
		found.push({ title, text, tables: tables.filter(({ rows }) => rows.length), plots });
	if (results.length) add(words.methodsTitle, methodsText(figures, words), [methodTable(results, words)]);
	const article = articleTable(figures, words);
	// Only with a row measured here beside the article's own.
	if (article.rows.length > ARTICLE.length) {
		const layers = methodTable(results_of_layers, words, words.tables.layers);
		add(words.articleTitle, words.articleText, [article, layers]);
	}
	const overdraw = overdrawTable(results, words);
	if (overdraw.rows.length) add(words.overdrawTitle, words.overdrawText, [overdraw]);
	if (costs.length || lights.length) {
		add(words.costsTitle, words.costsText, [
			costTable(words.tables.features, costs, words.tables.ofPlain, words),
			costTable(words.tables.light, lights, words.tables.ofOneLamp, words),
		]);
	}
	if (card.length) add(words.cardTitle, words.cardText(figures.device), [cardTable(card, words)]);
	const { shells, pixels, triangles } = words.curves;
	const plots = [
		curve(curves.shells, shells, words, (point) => point.shells),
		curve(curves.pixels, pixels, words, ({ width, height }) => (width * height) / 1e6),
		curve([...results_of_layers, ...results].filter(byMoving), triangles, words, (point) => point.triangles, true),
	].filter((svg) => svg !== undefined);
	if (plots.length) add(words.curvesTitle, words.curvesText, [], plots);
	return found;
}

const byMoving = ({ light, fins }: Result) => light === 'moving' && !fins;

function methodsText({ results, growth, rounds, clock }: BenchFigures, words: Words): string {
	const { width, height, shells } = results[0] as Result;
	const ptm = growth.filter(({ method }) => method === 'ptm');
	const steps = ptm.map(({ from, to, ratio }) => ({ from: count(from), to: count(to), ratio: times(ratio) }));
	const text = words.methodsText(width, height, shells, rounds, clock === 'readPixels');
	return steps.length ? `${text}${words.growth(steps)}` : text;
}

/** Line chart of a curve; undefined until there is a line to draw. */
function curve(
	points: readonly Point[],
	[title, x]: readonly [title: string, x: string],
	words: Words,
	of: (point: Point) => number,
	log = false,
): string | undefined {
	const ticks = [...new Set(points.map(of))].sort((a, b) => a - b);
	if (ticks.length < 2) return undefined;
	const series = LINES.map((method): Series => {
		const own = points.filter((point) => point.method === method).sort((a, b) => of(a) - of(b));
		return { name: words.methods[method], kind: method, points: own.map((point) => [of(point), point.median_ms]) };
	});
	return plot(
		series.filter((line) => line.points.length > 1),
		{ title, x, y: words.curves.unit, ticks, log },
	);
}
