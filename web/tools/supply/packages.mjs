/**
 * `npm run packages [-- --out FOLDER]`: the packages for npm, PyPI and Blender with their checksums, into `packages/` or the folder that
 * is named, looked over by publint, attw and twine. Nothing is published. Installs what it builds with, uv, build and twine.
 */
import { createHash } from 'node:crypto';
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { ensureNode, ensurePython, python } from '../environment.mjs';
import { ask, command, Failure, root, runAside, say, windows } from '../process.mjs';
import { packExtension } from './extension.mjs';

/** Each runs in an environment of its own, by uv. */
const BUILD = 'build==1.6.1';
const TWINE = 'twine==7.0.0';

const SUMS = 'SHA256SUMS';

/** @param {string} name; @param {Promise<number>} code */
async function must(name, code) {
	const found = await code;
	if (found !== 0) throw new Failure(`${name} failed with exit code ${found}`);
}

/** @param {string} folder; @returns {Promise<void>} */
async function packNode(folder) {
	const npm = process.env.npm_execpath;
	const args = ['pack', '--json', '--pack-destination', folder];
	const text = npm ? await ask(process.execPath, [npm, ...args]) : await ask('npm', args, { shell: windows });
	if (!text) throw new Failure('npm pack failed, expected npm 10 or newer');
	const file = join(folder, JSON.parse(text)[0].filename);
	const look = (/** @type {string[]} */ ...args) => runAside(process.execPath, args);
	const module = (/** @type {string[]} */ ...path) => join(root, 'node_modules', ...path);
	await must('publint', look(module('publint', 'src', 'cli.js'), 'run', file, '--strict'));
	// No CommonJS: Node requires modules from 20.19 on.
	const attw = module('@arethetypeswrong', 'cli', 'dist', 'index.js');
	await must('attw', look(attw, file, '--profile', 'esm-only', '--no-emoji', '--no-color'));
}

/** @param {string} folder */
async function packPython(folder) {
	const py = (/** @type {string[]} */ ...args) => runAside(python, ['-m', ...args], { cwd: join(root, 'baker') });
	await must('pip install uv', py('pip', 'install', '--quiet', '--disable-pip-version-check', 'uv>=0.9'));
	const tool = (/** @type {string} */ from, /** @type {string[]} */ ...args) =>
		py('uv', 'tool', 'run', '--quiet', '--from', from, ...args);
	await must('build', tool(BUILD, 'pyproject-build', '--outdir', folder, '.'));
	const files = readdirSync(folder).filter((name) => /\.(whl|tar\.gz)$/.test(name));
	await must('twine', tool(TWINE, 'twine', 'check', '--strict', ...files.map((name) => join(folder, name))));
}

await command(async () => {
	const { values } = parseArgs({ options: { out: { type: 'string', default: join(root, 'packages') } } });
	await ensureNode();
	await ensurePython({ dev: true });
	const folder = resolve(values.out);
	rmSync(join(folder, SUMS), { force: true });
	mkdirSync(folder, { recursive: true });
	if (readdirSync(folder).length > 0) throw new Failure(`${folder}: holds files, expected an empty folder`);
	// Before Blender's: npm builds the library for its own.
	await packNode(folder);
	packExtension(folder);
	await packPython(folder);
	const sums = readdirSync(folder)
		.sort()
		.map((name) => {
			const sum = createHash('sha256')
				.update(readFileSync(join(folder, name)))
				.digest('hex');
			return `${sum}  ${name}\n`;
		});
	writeFileSync(join(folder, SUMS), sums.join(''));
	say(`the packages are in ${folder}`);
});
