/**
 * `npm run lock [-- --upgrade]`: versions and hashes of all Python packages anew, into `baker/requirements/`, as
 * `baker/pyproject.toml` asks for them, the same for every Python and system. Installs what it does this with, uv.
 */
import { readdirSync } from 'node:fs';
import { join } from 'node:path';
import { ensurePython, lockFile, oldestPython, python } from '../environment.mjs';
import { command, Failure, root, run } from '../process.mjs';

await command(async () => {
	await ensurePython({ dev: true });
	const cwd = join(root, 'baker');
	const py = async (/** @type {string[]} */ ...args) => {
		const code = await run(python, ['-m', ...args], { cwd });
		if (code !== 0) throw new Failure(`${args.slice(0, 3).join(' ')} failed with exit code ${code}`);
	};
	await py('pip', 'install', '--quiet', '--disable-pip-version-check', 'uv>=0.9');
	const compile = ['uv', 'pip', 'compile', '--quiet', '--universal', '--fork-strategy', 'fewest', '--generate-hashes'];
	const short = ['--no-header', '--no-annotate', '--python-version', oldestPython.join('.')];
	const inputs = ['pyproject.toml', join('requirements', 'build.in')];
	const more = process.argv.slice(2);
	await py(...compile, ...short, ...more, '--extra', 'dev', ...inputs, '--output-file', lockFile(true));
	// Packages of both in one version.
	await py(...compile, ...short, ...more, '--constraint', lockFile(true), ...inputs, '--output-file', lockFile(false));
	console.log(readdirSync(join(cwd, 'requirements')).join('\n'));
});
