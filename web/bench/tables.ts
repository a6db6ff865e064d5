/** Figures as rows of text: what the page's tables say. */

import { ARTICLE, type BenchFigures, type Cost, type Result } from '../measure/results.ts';

/** A table's text; a cell is a heading where its column or row begins. */
export interface Table {
	caption: string;
	head: string[];
	rows: string[][];
}

export const count = (value: number) => value.toLocaleString('en').replaceAll(',', '\u00a0');
export const time = (milliseconds: number) =>
	milliseconds >= 100 ? milliseconds.toFixed(0) : milliseconds.toPrecision(3);
export const times = (factor: number) => (Number.isFinite(factor) ? `×\u00a0${factor.toFixed(2)}` : '–');

const TITLES: Record<Result['method'], string> = {
	unlit: 'unlit',
	lengyel: 'Lengyel',
	'shadow-layers': 'shadow layers',
	ptm: 'PTM',
	ptm3: 'PTM, 3 numbers',
	'ptm-colour': 'PTM with colours, 3 fetches',
};

/** What a row of the table is called, `PTM, still light` or the like. */
export function titleOf({ method, light, fins }: Pick<Result, 'method' | 'light' | 'fins'>): string {
	return [TITLES[method], ...(light === 'still' ? ['still light'] : []), ...(fins ? ['fins'] : [])].join(', ');
}

/** A row for every rival; for every number of triangles its time and what it is of unlit fur's. */
export function methodTable(results: readonly Result[], caption = 'Milliseconds a frame by triangles'): Table {
	const sizes = [...new Set(results.map(({ triangles }) => triangles))];
	const titles = [...new Set(results.map(titleOf))];
	return {
		caption,
		head: ['', ...sizes.flatMap((triangles) => [`${count(triangles)}: ms`, 'of unlit'])],
		rows: titles.map((title) => [
			title,
			...sizes.flatMap((triangles) => {
				const result = results.find((row) => row.triangles === triangles && titleOf(row) === title);
				return result ? [time(result.median_ms), times(result.ratio_to_unlit)] : ['–', '–'];
			}),
		]),
	};
}

/** The article's frames per second beside those measured here, its triangles taken for the body's and for all layers'. */
export function articleTable({
	results,
	results_of_layers,
}: Pick<BenchFigures, 'results' | 'results_of_layers'>): Table {
	const row = (triangles: number, who: string, shadows: number, ptm: number, faster: number) => [
		`${count(triangles)}, ${who}`,
		fps(shadows),
		fps(ptm),
		times(faster),
	];
	const here = (those: readonly Result[], triangles: number, named: number, who: string) => {
		const of = (method: Result['method']) =>
			those.find((one) => one.method === method && one.triangles === triangles && one.light === 'moving' && !one.fins);
		const [shadows, ptm] = [of('shadow-layers'), of('ptm')];
		if (!shadows || !ptm) return [];
		return [row(named, who, 1000 / shadows.median_ms, 1000 / ptm.median_ms, 1 / ptm.ratio_to_shadow_layers)];
	};
	return {
		caption: 'Frames per second by triangles',
		head: ['', 'shadow layers', 'PTM', 'PTM is faster'],
		rows: ARTICLE.flatMap(({ triangles, layered, ptm, ratio }) => [
			row(triangles, 'the article', layered.fps, ptm.fps, ratio),
			...here(results, triangles, triangles, 'here'),
			...here(results_of_layers, triangles / 16, triangles, 'here, all layers together'),
		]),
	};
}

const fps = (value: number) => value.toPrecision(3);

export function costTable(caption: string, costs: readonly Cost[], base: string): Table {
	return {
		caption,
		head: ['', 'ms', `of ${base}`],
		rows: costs.map(({ name, median_ms, ratio }) => [name, time(median_ms), times(ratio)]),
	};
}

/** Fragments per covered pixel, of every number of triangles. */
export function overdrawTable(results: readonly Result[]): Table {
	return {
		caption: 'Fragments per covered pixel',
		head: ['', 'covered', 'shaded', 'blended'],
		rows: results.flatMap(({ triangles, fins, overdraw }) => {
			if (!overdraw) return [];
			const { covered, shaded, blended } = overdraw;
			const title = `${count(triangles)} triangles${fins ? ', fins' : ''}`;
			return [[title, `${(100 * covered).toFixed(0)} %`, shaded.toFixed(1), blended.toFixed(1)]];
		}),
	};
}
