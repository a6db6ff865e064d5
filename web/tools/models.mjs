/**
 * Default models of `public/models/models.json`, and the lesson's data: bakes missing and stale ones.
 */
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { ensurePython, python } from './environment.mjs';
import { Failure, root, run, say } from './process.mjs';

/** All in one process: importing libraries takes Python longer than checking that a model is fresh. */
const bakeAll = `
import json, sys
from furbake.cli import main
sys.exit(max(main(arguments) for arguments in json.loads(sys.argv[1])))
`;

const cache = join(root, 'node_modules', '.cache', 'furbake');

/**
 * @typedef {object} DefaultModel
 * @property {string} name folder in public/models, and the name in the page's address
 * @property {string} title for the page's menu
 * @property {string} model input of furbake: a built-in, or `npm:` and a file in an npm package's module
 * @property {string[]} options of `furbake bake`, without those that the properties below stand for
 * @property {string} [preset] of a model: its fur
 * @property {string} [pelt] of a pelt: the preset that it is
 * @property {'ptm' | 'eigen'} [basis] of a pelt
 * @property {boolean} [wet] of a pelt: baked in states from dry to wet
 * @property {boolean} [dirt] of a pelt: baked in a dirty state
 * @property {number} [gloss] of a pelt: strength of the highlights of hairs that shine less than others
 * @property {number} [tips] of a pelt: how far a model's own second tip colour shows on it
 * @property {boolean} [fine] of a pelt: with the preset's own planes, which replace those of the preset's models once they have come
 * @property {boolean} [menu] false: not in the page's menu
 * @property {string} [view] first view and light, written as in the page's address
 */

/** @returns {DefaultModel[]} */
export function defaultModels() {
	return JSON.parse(readFileSync(join(root, 'public', 'models', 'models.json'), 'utf8'));
}

/**
 * All options of the command that bakes a model.
 *
 * @param {DefaultModel} model
 */
export function bakeOptions({ options, basis, wet, dirt }) {
	return [
		...options,
		...(basis === 'eigen' ? ['--basis', basis] : []),
		...(wet ? ['--states', 'dry..wet'] : []),
		...(dirt ? ['--dirt'] : []),
	];
}

/**
 * Path of a model's file for furbake. `npm:PACKAGE/FILE` means the module FILE.js, whose default export is FILE as a
 * data URI: unpacked once.
 *
 * @param {string} model
 */
async function unpacked(model) {
	if (!model.startsWith('npm:')) return model;
	const source = join(root, 'node_modules', `${model.slice('npm:'.length)}.js`);
	const target = join(cache, basename(source, '.js'));
	const { default: uri } = await import(pathToFileURL(source).href);
	const bytes = Buffer.from(uri.slice(uri.indexOf(',') + 1), 'base64');
	if (!existsSync(target) || !readFileSync(target).equals(bytes)) {
		mkdirSync(dirname(target), { recursive: true });
		writeFileSync(target, bytes);
	}
	return target;
}

/** Bakes missing and stale models. On failure prints one line, and existing models are served. */
export async function bakeDefaultModels() {
	try {
		await ensurePython();
	} catch (error) {
		if (!(error instanceof Failure)) throw error;
		say(`${error.message}: serving the models as they are`);
		return;
	}
	const bakes = [];
	for (const entry of defaultModels()) {
		const target = join('public', 'models', entry.name);
		bakes.push(['bake', await unpacked(entry.model), '-o', target, ...bakeOptions(entry), '--if-stale']);
	}
	bakes.push(['lesson', '-o', join('public', 'lesson'), '--if-stale']);
	// On standard error, like all output before the address, so that the progress bar sees a terminal.
	const code = await run(python, ['-c', bakeAll, JSON.stringify(bakes)], { cwd: root, stdio: ['ignore', 2, 2] });
	if (code !== 0) say(`baking failed with exit code ${code}: serving what could not be baked as it is`);
}
