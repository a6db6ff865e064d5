/**
 * `npm run sbom [-- --out FOLDER]`: lists of the packages of npm and of Python as CycloneDX, with the versions and hashes that
 * are locked, into `sbom/` or the folder that is named. Installs what it reads Python's with, uv and cyclonedx-bom.
 */
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { ensureNode, ensurePython, lockFile, python } from '../environment.mjs';
import { ask, command, Failure, root, runAside, say, windows } from '../process.mjs';

/** Reads requirements; runs in an environment of its own, by uv. */
const READER = 'cyclonedx-bom==7.5.0';

/** @returns {Promise<string>} the packages of `package-lock.json`, those that only build and test marked as such */
async function listNode() {
	const npm = process.env.npm_execpath;
	const args = ['sbom', '--sbom-format', 'cyclonedx', '--sbom-type', 'application', '--package-lock-only'];
	const text = npm ? await ask(process.execPath, [npm, ...args]) : await ask('npm', args, { shell: windows });
	if (!text) throw new Failure('npm sbom failed, expected npm 10 or newer');
	const list = JSON.parse(text);
	// npm names the folder.
	list.metadata.component.name = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8')).name;
	return `${JSON.stringify(list, null, 2)}\n`;
}

/** @param {string} file is written: the packages that the baker needs, as locked */
async function listPython(file) {
	// The reader warns that requirements do not say which package needs which.
	const env = { ...process.env, PYTHONWARNINGS: 'ignore' };
	const py = async (/** @type {string[]} */ ...args) => {
		const code = await runAside(python, ['-m', ...args], { cwd: join(root, 'baker'), env });
		if (code !== 0) throw new Failure(`${args.slice(0, 3).join(' ')} failed with exit code ${code}`);
	};
	await py('pip', 'install', '--quiet', '--disable-pip-version-check', 'uv>=0.9');
	const read = ['uv', 'tool', 'run', '--quiet', '--from', READER, 'cyclonedx-py', 'requirements'];
	await py(...read, '--pyproject', 'pyproject.toml', '--output-file', file, lockFile(false));
}

await command(async () => {
	const { values } = parseArgs({ options: { out: { type: 'string', default: join(root, 'sbom') } } });
	await ensureNode();
	await ensurePython({ dev: true });
	const folder = resolve(values.out);
	mkdirSync(folder, { recursive: true });
	writeFileSync(join(folder, 'npm.cdx.json'), await listNode());
	await listPython(join(folder, 'python.cdx.json'));
	say(`the lists are in ${folder}`);
});
