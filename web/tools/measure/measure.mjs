/** Shared parts of commands that measure a baked model in a page. */
import { existsSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { browserArgs, ensureBrowser, openModule } from '../browser.mjs';
import { Failure, root } from '../process.mjs';
import { serve } from '../site/vite.mjs';

/** Working directory of the caller. */
const called = process.env.INIT_CWD ?? process.cwd();

/**
 * @template {NonNullable<import('node:util').ParseArgsConfig['options']>} Options
 * @param {Options} options of the command line
 */
export function readOptions(options) {
	try {
		return parseArgs({ options }).values;
	} catch (error) {
		throw new Failure(/** @type {Error} */ (error).message);
	}
}

/** @param {string} model a default model's name or a folder; @returns {string} folder of its files */
export function folderOf(model) {
	const named = join(root, 'public', 'models', model);
	const folder = !/[\\/.]/.test(model) && existsSync(named) ? named : resolve(called, model);
	if (!existsSync(join(folder, 'model.gltf')))
		throw new Failure(`--model: got ${model}, expected a folder in public/models or one with a model.gltf in it`);
	return folder;
}

/**
 * Opens a page with a module of web/ as `loaded`, and the model's files at /baked/. Needs `ensureNode`.
 *
 * @template T
 * @param {string} folder of the model
 * @param {string} module its address
 * @param {(page: import('@playwright/test').Page) => Promise<T>} measure
 * @returns {Promise<T>}
 */
export async function inPage(folder, module, measure) {
	const { chromium } = await import('@playwright/test');
	const server = await serve();
	const browser = await chromium.launch({ executablePath: await ensureBrowser(), args: browserArgs });
	try {
		const page = await browser.newPage();
		await page.route('**/baked/**', (route) => {
			const path = join(folder, decodeURIComponent(new URL(route.request().url()).pathname.slice('/baked/'.length)));
			return existsSync(path) ? route.fulfill({ path }) : route.fulfill({ status: 404 });
		});
		await openModule(page, server.url, module);
		return await measure(page);
	} catch (error) {
		const [line] = /** @type {Error} */ (error).message.split('\n');
		throw new Failure(line.replace(/^page\.evaluate: (Error: )?/, ''));
	} finally {
		await browser.close();
		await server.close();
	}
}

/** @param {string | undefined} file of option --json; @param {unknown} figures */
export function writeFigures(file, figures) {
	if (!file) return;
	try {
		writeFileSync(resolve(called, file), `${JSON.stringify(figures, null, '\t')}\n`);
	} catch (error) {
		throw new Failure(`--json: ${/** @type {Error} */ (error).message}`);
	}
}
