/**
 * `npm run fins [-- --model NAME|FOLDER --json FILE]`: what fins add to a baked model's outline, and what they cost.
 */
import { existsSync, writeFileSync } from 'node:fs';
import { basename, join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { browserArgs, ensureBrowser, openModule } from './browser.mjs';
import { ensureNode } from './environment.mjs';
import { command, Failure, root, say } from './process.mjs';
import { table } from './table.mjs';
import { serve } from './vite.mjs';

/** @import { FinFigures } from '../bench/figures.ts' */

const options = /** @type {const} */ ({ model: { type: 'string', default: 'bunny' }, json: { type: 'string' } });
const called = process.env.INIT_CWD ?? process.cwd();

/** @param {string} model a default model's name or a folder; @returns {string} the folder of its files */
function folderOf(model) {
	const named = join(root, 'public', 'models', model);
	const folder = !/[\\/.]/.test(model) && existsSync(named) ? named : resolve(called, model);
	if (!existsSync(join(folder, 'model.gltf')))
		throw new Failure(`--model: got ${model}, expected a folder in public/models or one with a model.gltf in it`);
	return folder;
}

/** @param {string} folder; @returns {Promise<FinFigures>} */
async function measure(folder) {
	const { chromium } = await import('@playwright/test');
	const server = await serve();
	const browser = await chromium.launch({ executablePath: await ensureBrowser(), args: browserArgs });
	try {
		const page = await browser.newPage();
		await page.route('**/baked/**', (route) => {
			const path = join(folder, decodeURIComponent(new URL(route.request().url()).pathname.slice('/baked/'.length)));
			return existsSync(path) ? route.fulfill({ path }) : route.fulfill({ status: 404 });
		});
		await openModule(page, server.url, '/bench/fins.ts');
		// As text: what it calls is in the page.
		return await page.evaluate("loaded.measureFins('/baked/model.gltf')");
	} catch (error) {
		const [line] = /** @type {Error} */ (error).message.split('\n');
		throw new Failure(line.replace(/^page\.evaluate: (Error: )?/, ''));
	} finally {
		await browser.close();
		await server.close();
	}
}

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
	let values;
	try {
		({ values } = parseArgs({ options }));
	} catch (error) {
		throw new Failure(/** @type {Error} */ (error).message);
	}
	const folder = folderOf(values.model);
	await ensureNode();
	say(`measuring ${basename(folder)}; software rendering takes a minute or two`);
	const figures = await measure(folder);
	console.log(report(basename(folder), figures));
	if (values.json) {
		const text = `${JSON.stringify({ model: basename(folder), ...figures }, null, '\t')}\n`;
		try {
			writeFileSync(resolve(called, values.json), text);
		} catch (error) {
			throw new Failure(`--json: ${/** @type {Error} */ (error).message}`);
		}
	}
});
