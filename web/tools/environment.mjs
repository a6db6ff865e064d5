/**
 * Installs missing dependencies of both wings. Runs on Node alone: imports no dependency.
 */
import { createHash } from 'node:crypto';
import { existsSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { ask, Failure, root, run, runAside, say, windows } from './process.mjs';

const oldestNode = [20, 19];
export const oldestPython = [3, 11];
const venv = join(root, 'baker', '.venv');
const bin = join(venv, windows ? 'Scripts' : 'bin');
const stamp = join(venv, 'furbake.stamp');

/** Python of the project and its command `furbake`; they exist after `ensurePython`. */
export const python = join(bin, windows ? 'python.exe' : 'python');
export const furbake = join(bin, windows ? 'furbake.exe' : 'furbake');

/**
 * @param {string} version such as 'v20.20.2'
 * @param {number[]} oldest
 */
function atLeast(version, [major, minor]) {
	const [a, b] = version.replace(/^v/, '').split('.').map(Number);
	return a > major || (a === major && b >= minor);
}

/** @param {string} file a lock file of npm; @returns {Record<string, any>} its packages by path */
function packages(file) {
	try {
		return JSON.parse(readFileSync(join(root, file), 'utf8')).packages;
	} catch {
		return {};
	}
}

/** Compares npm's record of installed packages with the lock file. */
export function nodeIsInstalled() {
	const installed = packages('node_modules/.package-lock.json');
	return Object.entries(packages('package-lock.json')).every(
		([path, { version, optional }]) => path === '' || optional || installed[path]?.version === version,
	);
}

/** Node's wing: `node_modules` as in `package-lock.json`. */
export async function ensureNode() {
	if (!atLeast(process.version, oldestNode))
		throw new Failure(`Node ${process.version} is too old, need ${oldestNode.join('.')} or newer`);
	if (nodeIsInstalled()) return;
	say('installing the web wing (npm ci)');
	// npm names itself in npm_execpath; a bare `npm` is a shell script on Windows.
	const npm = process.env.npm_execpath;
	const args = ['ci', '--include=dev', '--no-audit', '--no-fund', '--loglevel=error'];
	const code = npm ? await runAside(process.execPath, [npm, ...args]) : await runAside('npm', args, { shell: windows });
	if (code !== 0) throw new Failure(`npm ci failed with exit code ${code}`);
}

/** @returns {Promise<string[] | undefined>} command line of a Python that is new enough */
async function findPython() {
	const names = ['python3', 'python', 'python3.14', 'python3.13', 'python3.12', 'python3.11'].map((name) => [name]);
	const candidates = windows ? [['py', '-3'], ...names] : names;
	const program = 'import sys; print("%d.%d" % sys.version_info[:2])';
	for (const [name, ...args] of candidates) {
		const version = await ask(name, [...args, '-c', program]);
		if (version && atLeast(version, oldestPython)) return [name, ...args];
	}
	return undefined;
}

/** Versions and hashes of the packages, by `npm run lock`. @param {boolean} dev with the tools for tests and checks */
export function lockFile(dev) {
	return join(root, 'baker', 'requirements', dev ? 'dev.txt' : 'use.txt');
}

/** Recipe of the environment, which is rebuilt when it changes. @param {boolean} dev */
function recipe(dev) {
	const found = createHash('sha256');
	for (const file of [join(root, 'baker', 'pyproject.toml'), lockFile(dev)]) found.update(readFileSync(file));
	found.update(JSON.parse(readFileSync(join(root, 'package.json'), 'utf8')).version);
	return `${found.digest('hex')} ${dev ? 'dev' : 'use'} ${root}`;
}

/**
 * Python's wing: `baker/.venv` with `furbake` in it, editable.
 *
 * @param {object} [options]
 * @param {boolean} [options.dev] with the tools for tests and checks
 */
export async function ensurePython({ dev = false } = {}) {
	const made = existsSync(stamp) && existsSync(python) ? readFileSync(stamp, 'utf8') : '';
	if (made === recipe(true) || (!dev && made === recipe(false))) return;
	const tools = dev || made.includes(' dev ');

	if (!made.endsWith(` ${root}`)) {
		const found = await findPython();
		if (!found) throw new Failure(`no Python ${oldestPython.join('.')} or newer found`);
		say('making the Python environment (baker/.venv)');
		rmSync(venv, { recursive: true, force: true });
		const [name, ...args] = found;
		if ((await runAside(name, [...args, '-m', 'venv', venv])) !== 0) {
			rmSync(venv, { recursive: true, force: true });
			throw new Failure('Python cannot make an environment; on Debian and Ubuntu: apt install python3-venv');
		}
	}
	say('installing the baker wing (pip)');
	const pip = ['-m', 'pip', 'install', '--quiet', '--disable-pip-version-check'];
	const steps = [
		['--require-hashes', '--requirement', lockFile(tools)],
		['--no-deps', '--no-build-isolation', '--editable', join(root, 'baker')],
	];
	for (const step of steps) {
		const code = await runAside(python, [...pip, ...step]);
		if (code !== 0) throw new Failure(`pip install failed with exit code ${code}`);
	}
	writeFileSync(stamp, recipe(tools));
}

/** Blender as a Python package, and the one version of Python that it is for. */
const blender = 'bpy==4.5.15';
const blenderPython = '3.11';
const blenderVenv = join(root, 'baker', '.bpy');

/**
 * Python with Blender in it, `baker/.bpy`, for tests of the extension; a wheel of 0.35 GB, which pip keeps in its cache.
 *
 * @returns {Promise<string>} its path
 */
export async function ensureBlender() {
	const inside = join(blenderVenv, windows ? 'Scripts' : 'bin', windows ? 'python.exe' : 'python');
	if (existsSync(inside) && (await ask(inside, ['-c', 'import bpy'])) !== undefined) return inside;
	const candidates = windows ? [['py', `-${blenderPython}`]] : [[`python${blenderPython}`], ['python3']];
	const program = 'import sys; print("%d.%d" % sys.version_info[:2])';
	for (const [name, ...args] of candidates) {
		if ((await ask(name, [...args, '-c', program]))?.trim() !== blenderPython) continue;
		say('installing Blender as a Python package (baker/.bpy)');
		const made = await runAside(name, [...args, '-m', 'venv', '--clear', blenderVenv]);
		const quiet = ['--quiet', '--disable-pip-version-check'];
		const installed = made === 0 && (await runAside(inside, ['-m', 'pip', 'install', ...quiet, blender])) === 0;
		if (installed && (await ask(inside, ['-c', 'import bpy'])) !== undefined) return inside;
		rmSync(blenderVenv, { recursive: true, force: true });
		throw new Failure(
			installed
				? `${blender} cannot be imported: libraries of the system are missing`
				: `pip install ${blender} failed`,
		);
	}
	throw new Failure(`no Python ${blenderPython} found, which ${blender} is for`);
}

/**
 * The command `furbake` of this project.
 *
 * @param {string[]} args
 * @param {import('node:child_process').SpawnOptions} [options]
 */
export function runFurbake(args, options) {
	return run(furbake, args, options);
}
