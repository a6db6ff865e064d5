/** What the page says of the figures: sections of tables and plots, of what there is so far. */

import { ARTICLE, type BenchFigures, type Point, type Result } from '../measure/results.ts';
import { plot, type Series } from './plot.ts';
import { articleTable, costTable, count, methodTable, overdrawTable, type Table, times } from './tables.ts';

export interface Section {
	title: string;
	/** One paragraph below the title. */
	words: string;
	tables: Table[];
	/** SVG text. */
	plots: string[];
}

/** Lines of the plots and how they are coloured. */
const LINES: [method: Result['method'], name: string][] = [
	['shadow-layers', 'shadow layers'],
	['ptm', 'PTM'],
	['unlit', 'unlit'],
];

export function sections(figures: BenchFigures): Section[] {
	const { results, results_of_layers, growth, costs, lights, curves } = figures;
	const found: Section[] = [];
	if (results.length) {
		const { shells, width, height } = results[0] as Result;
		found.push({
			title: 'Methods',
			words: `Milliseconds a frame at ${width} × ${height} with ${shells} shells: the median of ${figures.rounds === 1 ? 'one round' : `${figures.rounds} rounds`} of turns there and back, each frame ended by ${figures.clock === 'readPixels' ? 'reading a pixel of it' : "the GPU's own clock"}. Ratios are medians of the rounds' ratios. ${grown(growth)}`,
			tables: [methodTable(results)],
			plots: [],
		});
	}
	const article = articleTable(figures);
	// Beside the article's own rows there has to be one from here.
	if (article.rows.length > ARTICLE.length) {
		found.push({
			title: "The article's Table 1",
			words:
				"Frames per second. The article does not say whether its numbers of triangles are the body's or the sum over all 16 layers, so both are measured. Its machine was a Quadro NVS 110 with 64 MB, its rival a layered shadow map of which no text is to be had.",
			tables: [
				article,
				methodTable(
					results_of_layers,
					'Milliseconds a frame by triangles of the body, of which 16 layers have 512, 4 608 and 16 896',
				),
			].filter(({ rows }) => rows.length),
			plots: [],
		});
	}
	if (results.some(({ overdraw }) => overdraw)) {
		found.push({
			title: 'Overdraw',
			words:
				'Share of the picture that fur covers, and fragments there per pixel: shaded at the most (in front of the skin), and blended (above the alpha cut and not behind other fur).',
			tables: [overdrawTable(results)],
			plots: [],
		});
	}
	if (costs.length || lights.length) {
		found.push({
			title: 'What else costs what',
			words: `PTM with 4 608 triangles. First what fur can have besides, each by itself and all together, then what light costs: whether it moves, eight lamps for one, and fins.`,
			tables: [
				costTable('What fur can have besides', costs, 'plain'),
				costTable('What light costs', lights, 'one lamp'),
			],
			plots: [],
		});
	}
	const plots = [
		curve(curves.shells, 'Shells', 'shells', ({ shells }) => shells),
		curve(curves.pixels, 'Pixels', 'million pixels', ({ width, height }) => (width * height) / 1e6),
		curve(
			[...results_of_layers, ...results].filter(byMoving),
			'Triangles',
			'triangles',
			({ triangles }) => triangles,
			true,
		),
	].filter((svg) => svg !== undefined);
	if (plots.length) {
		found.push({
			title: 'What a frame grows with',
			words: 'Milliseconds a frame against the number of shells, of pixels and of triangles.',
			tables: [],
			plots,
		});
	}
	return found;
}

const byMoving = ({ light, fins }: Result) => light === 'moving' && !fins;

function grown(growth: BenchFigures['growth']): string {
	const ptm = growth.filter(({ method }) => method === 'ptm');
	if (!ptm.length) return '';
	const said = ptm.map(({ from, to, ratio }) => `from ${count(from)} to ${count(to)} triangles ${times(ratio)}`);
	return `A frame of PTM grows ${said.join(', ')}.`;
}

/** Undefined where there is not yet a line to draw. */
function curve(
	points: readonly Point[],
	title: string,
	x: string,
	of: (point: Point) => number,
	log = false,
): string | undefined {
	const ticks = [...new Set(points.map(of))].sort((a, b) => a - b);
	if (ticks.length < 2) return undefined;
	const series = LINES.map(([method, name]): Series => {
		const own = points.filter((point) => point.method === method).sort((a, b) => of(a) - of(b));
		return { name, kind: method, points: own.map((point) => [of(point), point.median_ms]) };
	});
	return plot(
		series.filter((line) => line.points.length > 1),
		{ title, x, y: 'ms', ticks, log },
	);
}
