/**
 * `npm run check [-- --write]`: lint, format and types of both wings. Warnings fail.
 * `--write` lets the tools repair what they can.
 */
import { join } from 'node:path';
import { checkAddressTable } from './address.mjs';
import { ensureNode, ensurePython, python } from './environment.mjs';
import { command, root, run } from './process.mjs';

await command(async () => {
	await ensureNode();
	await ensurePython({ dev: true });

	const write = process.argv.includes('--write');
	const web = join(root, 'web');
	const baker = join(root, 'baker');
	const module = (/** @type {string[]} */ ...path) => join(root, 'node_modules', ...path);
	const node = (/** @type {string} */ script, /** @type {string[]} */ ...args) =>
		run(process.execPath, [script, ...args], { cwd: web });
	// From baker/, so that its pyproject.toml applies to the tests too.
	const py = (/** @type {string[]} */ ...args) => run(python, ['-m', ...args], { cwd: baker });

	const biome = module('@biomejs', 'biome', 'bin', 'biome');
	const tsc = module('@typescript', 'native', 'bin', 'tsc');
	const pyproject = ['--config', 'pyproject.toml'];
	const sources = ['.', join('..', 'tests', 'baker'), join('..', 'tests', 'golden')];

	/** @type {[string, () => Promise<number>][]} */
	const checks = [
		[
			'biome',
			() =>
				node(
					biome,
					'check',
					'--error-on-warnings',
					...(write ? ['--write'] : []),
					'.',
					'../tests',
					'../baker/blender/page',
					'../public/models/models.json',
				),
		],
		['tsc web', () => node(tsc, '-p', '.')],
		['tsc web/tools', () => node(tsc, '-p', 'tools')],
		['tsc tests', () => node(tsc, '-p', join('..', 'tests'))],
		// Every public name has a docstring; `npm run docs` makes pages of them.
		['typedoc', () => node(module('typedoc', 'bin', 'typedoc'), '--options', 'typedoc.json', '--emit', 'none')],
		['web/docs/address.md', async () => ((await checkAddressTable(write)) ? 0 : 1)],
		['ruff check', () => py('ruff', 'check', ...(write ? ['--fix'] : []), ...pyproject, ...sources)],
		['ruff format', () => py('ruff', 'format', ...(write ? [] : ['--check']), ...pyproject, ...sources)],
		['mypy', () => py('mypy', '--strict', 'furbake')],
		// Those that do without Blender, which has no types.
		['mypy blender', () => py('mypy', '--strict', ...['command', 'job', 'serve'].map((name) => `blender/${name}.py`))],
	];
	/** @type {string[]} */
	const failed = [];
	for (const [name, check] of checks) if ((await check()) !== 0) failed.push(name);
	console.log(failed.length ? `check failed: ${failed.join(', ')}` : 'check ok');
	return failed.length ? 1 : 0;
});
