/** `npm run library`: builds the library for other apps in lib/, a module per entry point with its types, and `<fur-view>`; `npm pack` runs it first. */
import { copyFileSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { ensureNode } from './environment.mjs';
import { command, Failure, root, runAside, say } from './process.mjs';

const folder = join(root, 'lib');

/**
 * Rewrites imports of sources (`./shells.ts`) in declarations to those of built modules.
 *
 * @param {string} text
 */
function withModules(text) {
	return text.replace(/(\bfrom |\bimport\()(['"])(\.{1,2}\/[^'"]+)\.ts\2/g, '$1$2$3.js$2');
}

await command(async () => {
	await ensureNode();
	/** Keeps standard output free, for `npm pack --json`. @param {string} name @param {...string} args */
	const step = async (name, ...args) => {
		const code = await runAside(process.execPath, [join(root, 'node_modules', name), ...args]);
		if (code !== 0) throw new Failure(`${name} failed with exit code ${code}`);
	};
	for (const config of ['vite.library.config.ts', 'vite.view.config.ts'])
		await step('vite/bin/vite.js', 'build', '--config', join('web', config), '--logLevel', 'warn');
	await step('@typescript/native/bin/tsc', '-p', join('web', 'tsconfig.library.json'));
	for (const file of readdirSync(folder, { recursive: true, encoding: 'utf8' })) {
		if (!file.endsWith('.d.ts')) continue;
		const path = join(folder, file);
		writeFileSync(path, withModules(readFileSync(path, 'utf8')));
	}
	copyFileSync(join(root, 'web', 'view', 'view.d.ts'), join(folder, 'fur-view.d.ts'));
	say('the library is in lib/');
});
