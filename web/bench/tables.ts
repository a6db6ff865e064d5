/** Tables of figures as rows of text. */

import { ARTICLE, type BenchFigures, type CardPoint, type Cost, type Result } from '../measure/bench/results.ts';
import type { Words } from './words/en.ts';

/** Text of a table; the first cell of a column or row is a heading. */
export interface Table {
	caption: string;
	head: string[];
	rows: string[][];
}

export const count = (value: number) => value.toLocaleString('en').replaceAll(',', '\u00a0');
export const time = (milliseconds: number) =>
	milliseconds >= 100 ? milliseconds.toFixed(0) : milliseconds.toPrecision(3);
export const times = (factor: number) => (Number.isFinite(factor) ? `×\u00a0${factor.toFixed(2)}` : '–');

/** Title of a row, such as `PTM, still light`. */
export function titleOf({ method, light, fins }: Pick<Result, 'method' | 'light' | 'fins'>, words: Words): string {
	return words.subject(method, light === 'still', fins);
}

/** A row per method; per number of triangles its time, and the ratio to unlit fur's. */
export function methodTable(results: readonly Result[], words: Words, caption = words.tables.methods): Table {
	const { milliseconds, ofUnlit } = words.tables;
	const sizes = [...new Set(results.map(({ triangles }) => triangles))];
	const titles = [...new Set(results.map((row) => titleOf(row, words)))];
	return {
		caption,
		head: ['', ...sizes.flatMap((triangles) => [milliseconds(count(triangles)), ofUnlit])],
		rows: titles.map((title) => [
			title,
			...sizes.flatMap((triangles) => {
				const result = results.find((row) => row.triangles === triangles && titleOf(row, words) === title);
				return result ? [time(result.median_ms), times(result.ratio_to_unlit)] : ['–', '–'];
			}),
		]),
	};
}

/** Frames per second of the article beside those measured here, its triangles taken for the body's and for all layers'. */
export function articleTable(
	{ results, results_of_layers }: Pick<BenchFigures, 'results' | 'results_of_layers'>,
	{ tables }: Words,
): Table {
	const row = (title: string, shadows: number, ptm: number, faster: number) => [
		title,
		fps(shadows),
		fps(ptm),
		times(faster),
	];
	const here = (those: readonly Result[], triangles: number, title: string) => {
		const of = (method: Result['method']) =>
			those.find((one) => one.method === method && one.triangles === triangles && one.light === 'moving' && !one.fins);
		const [shadows, ptm] = [of('shadow-layers'), of('ptm')];
		if (!shadows || !ptm) return [];
		return [row(title, 1000 / shadows.median_ms, 1000 / ptm.median_ms, 1 / ptm.ratio_to_shadow_layers)];
	};
	return {
		caption: tables.article,
		head: ['', tables.shadowLayers, tables.ptm, tables.faster],
		rows: ARTICLE.flatMap(({ triangles, layered, ptm, ratio }) => [
			row(tables.theArticle(count(triangles)), layered.fps, ptm.fps, ratio),
			...here(results, triangles, tables.here(count(triangles))),
			...here(results_of_layers, triangles / 16, tables.hereOfLayers(count(triangles))),
		]),
	};
}

const fps = (value: number) => value.toPrecision(3);

/** @param ratioHead heading of the ratio's column */
export function costTable(caption: string, costs: readonly Cost[], ratioHead: string, words: Words): Table {
	return {
		caption,
		head: ['', 'ms', ratioHead],
		rows: costs.map(({ name, median_ms, ratio }) => [words.costs[name], time(median_ms), times(ratio)]),
	};
}

/** Full pictures and herds: a row per number of shells and bodies, a column per size of the picture. */
export function cardTable(points: readonly CardPoint[], { tables }: Words): Table {
	const sizeOf = ({ width, height }: CardPoint) => `${width} × ${height}`;
	const titleOf = ({ shells, bodies }: CardPoint) => tables.shells(shells, bodies);
	const sizes = [...new Set(points.map(sizeOf))];
	return {
		caption: tables.card,
		head: ['', ...sizes],
		rows: [...new Set(points.map(titleOf))].map((title) => [
			title,
			...sizes.map((size) => {
				const point = points.find((one) => titleOf(one) === title && sizeOf(one) === size);
				return point ? `${time(point.median_ms)} (${time(1000 / point.median_ms)})` : '–';
			}),
		]),
	};
}

/** Fragments per covered pixel, by number of triangles. */
export function overdrawTable(results: readonly Result[], { tables }: Words): Table {
	return {
		caption: tables.overdraw,
		head: ['', tables.covered, tables.shaded, tables.blended],
		rows: results.flatMap(({ triangles, fins, overdraw }) => {
			if (!overdraw) return [];
			const { covered, shaded, blended } = overdraw;
			const title = tables.triangles(count(triangles), fins);
			return [[title, `${(100 * covered).toFixed(0)} %`, shaded.toFixed(1), blended.toFixed(1)]];
		}),
	};
}
