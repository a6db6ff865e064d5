/** Runs Vite's own command line with the project's configuration. */
import { join } from 'node:path';
import { root, run } from './process.mjs';

/** @param {string[]} args @returns {Promise<number>} exit code */
export function vite(args) {
	const [verb, ...rest] = args;
	const config = ['--config', join(root, 'web', 'vite.config.ts')];
	return run(process.execPath, [join(root, 'node_modules', 'vite', 'bin', 'vite.js'), verb, ...config, ...rest]);
}
