/**
 * `npm run fins [-- --model NAME|FOLDER --json FILE]`: gain of fins in a baked model's outline, and their cost.
 */
import { basename } from 'node:path';
import { command, say } from '../process.mjs';
import { folderOf, inPage, readOptions, writeFigures } from './measure.mjs';
import { table } from './table.mjs';

/** @import { FinFigures } from '../../measure/figures.ts' */

const options = /** @type {const} */ ({ model: { type: 'string', default: 'bunny' }, json: { type: 'string' } });

const percent = (/** @type {number} */ part, /** @type {number} */ whole) =>
	whole ? `${((100 * part) / whole).toFixed(2)} %` : '-';

/** @param {string} name; @param {FinFigures} figures; @returns {string} */
function report(name, { width, height, length, views, costs }) {
	const row = (/** @type {string} */ title, /** @type {FinFigures['views']} */ of) => {
		/** @param {(view: FinFigures['views'][0]) => number} count */
		const sum = (count) => of.reduce((total, view) => total + count(view), 0);
		/** @param {'beside' | 'all' | 'extra'} which; @param {number} whole */
		const shares = (which, whole) =>
			/** @type {const} */ (['without', 'fins']).map((key) =>
				percent(
					sum((view) => view[which][key]),
					whole,
				),
			);
		const beside = sum((view) => view.beside.pixels);
		const all = sum((view) => view.all.pixels);
		const finPixels = sum((view) => view.finPixels);
		const outside = sum((view) => view.outside);
		const covered = [`${beside}`, ...shares('beside', beside), `${all}`, ...shares('all', all)];
		return [title, ...covered, ...shares('extra', beside), `${finPixels}`, percent(outside, finPixels)];
	};
	const shares = ['no fins', 'fins'];
	const heads = ['16 shells', 'beside skin', ...shares, 'all', ...shares, 'extra', 'fins', 'fin pixels', 'outside'];
	const times = costs.map(({ shells, without, fins, ratio }) => [
		`${shells} shells`,
		...[without, fins].map((time) => `${time.toFixed(1)} ms`),
		`x ${ratio.toFixed(3)}`,
	]);
	return `${name}, ${width} x ${height} pixels, fur ${length.toFixed(1)} pixels long

Pixels at least half covered, of those that 64 shells without fins cover at least half:
beside skin = where the bare skin does not; all = wherever they do.
extra = pixels at least half covered that 64 shells cover less, in shares of those beside the skin.
outside = share of fin pixels farther than the fur's length from all of them.

${table([heads, ...views.map((view) => row(view.name, [view])), row('together', views)])}

Frame time, finished by readPixels; median of frames and of the ratio of rounds (without, with, with, without):

${table([['', 'no fins', 'fins', 'ratio'], ...times])}`;
}

await command(async () => {
	const values = readOptions(options);
	const folder = folderOf(values.model);
	say(`measuring ${basename(folder)}; software rendering takes a minute or two`);
	// As text, since it calls functions in the page.
	/** @type {FinFigures} */
	const figures = await inPage(folder, '/measure/fins.ts', (page) =>
		page.evaluate("loaded.measureFins('/baked/model.gltf')"),
	);
	console.log(report(basename(folder), figures));
	writeFigures(values.json, { model: basename(folder), ...figures });
});
