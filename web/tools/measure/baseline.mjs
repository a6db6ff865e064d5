/** Figures of a run of the bench beside those of a stored one. */
import { readFileSync } from 'node:fs';
import { Failure } from '../process.mjs';

/** @import { BenchFigures, Result } from '../../measure/bench/results.ts' */

/** Figure of a row, lower is better, and the row's own milliseconds. @typedef {{ figure: number, ms: number }} Timed */

/** Parts of the figures, and the row that each of their ratios is relative to. @satisfies {Record<string, string>} */
const PARTS = /** @type {const} */ ({
	results: 'of unlit',
	results_of_layers: 'of unlit, triangles over all layers',
	costs: 'of plain PTM',
	lights: 'of one lamp',
});

/**
 * Figures written by `npm run bench -- --json FILE`.
 *
 * @param {string} path
 * @returns {BenchFigures}
 */
export function readBaseline(path) {
	let figures;
	try {
		figures = JSON.parse(readFileSync(path, 'utf8'));
	} catch (error) {
		throw new Failure(`--baseline: ${path}: ${/** @type {Error} */ (error).message}`);
	}
	const odd = Object.keys(PARTS).find(
		(part) => !Array.isArray(figures?.[part]) || figures[part].some((/** @type {unknown} */ row) => !timed(row)),
	);
	if (odd)
		throw new Failure(`--baseline: ${path}: got no figures in ${odd}, expected a file of npm run bench -- --json FILE`);
	return figures;
}

/**
 * @param {any} row result or cost
 * @returns {Timed | undefined}
 */
function timed(row) {
	const [figure, ms] = [row?.ratio_to_unlit ?? row?.ratio, row?.median_ms];
	// A ratio is null in the file where its base was not measured.
	return typeof ms === 'number' && ms > 0
		? { figure: typeof figure === 'number' ? figure : Number.NaN, ms }
		: undefined;
}

/** Title of a row, the same in both runs for the same work. @param {any} row */
function titleOf(row) {
	if (row.name) return row.name;
	const { method, light, fins, triangles, shells, width, height } = /** @type {Result} */ (row);
	const how = [method, light === 'still' ? 'still light' : '', fins ? 'fins' : ''].filter(Boolean).join(', ');
	return `${how}, ${triangles} triangles x ${shells} shells, ${width} x ${height}`;
}

/** @param {number} value */
const two = (value) => (Number.isFinite(value) ? value.toFixed(2) : '-');

/**
 * Tables of the rows that both runs have: their ratios, which are free of the machine's speed, and milliseconds.
 *
 * @param {BenchFigures} before
 * @param {BenchFigures} now
 * @param {(rows: string[][]) => string} written rows as text
 */
export function against(before, now, written) {
	const texts = [];
	for (const [part, base] of Object.entries(PARTS)) {
		const old = new Map(before[/** @type {keyof typeof PARTS} */ (part)].map((row) => [titleOf(row), timed(row)]));
		const rows = now[/** @type {keyof typeof PARTS} */ (part)].flatMap((row) => {
			const [title, own] = [titleOf(row), timed(row)];
			const then = old.get(title);
			if (!own || !then) return [];
			const figures = [then.figure, own.figure, own.figure / then.figure].map(two);
			return [[title, ...figures, then.ms.toPrecision(3), own.ms.toPrecision(3), two(own.ms / then.ms)]];
		});
		const head = ['', `${base}: before`, 'now', 'now / before', 'ms: before', 'now', 'now / before'];
		if (rows.length) texts.push(`Against the baseline: ${base}\n\n${written([head, ...rows])}`);
	}
	if (!texts.length) return 'Against the baseline: no row is in both runs';
	const machines = /** @type {const} */ (['device', 'browser', 'clock']).filter((key) => before[key] !== now[key]);
	const other = machines.map((key) => `${key} was ${before[key]}`).join('; ');
	return [...texts, ...(other ? [`Another machine: ${other}. Compare ratios alone.`] : [])].join('\n\n');
}
