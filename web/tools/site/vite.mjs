/** Vite with the project's configuration: its own command line, and its server for pages that are measured. */
import { join } from 'node:path';
import { root, run } from '../process.mjs';

/** @param {string[]} args @returns {Promise<number>} exit code */
export function vite(args) {
	const [verb, ...rest] = args;
	const config = ['--config', join(root, 'web', 'vite.config.ts')];
	return run(process.execPath, [join(root, 'node_modules', 'vite', 'bin', 'vite.js'), verb, ...config, ...rest]);
}

/**
 * Serves web/ as `npm start` does, on its own port, without reloading pages.
 *
 * @param {import('vite').Plugin[]} [plugins] further plugins
 * @returns {Promise<{ url: string, close: () => Promise<void> }>} address, ending in a slash, and function that ends the server
 */
export async function serve(plugins = []) {
	const { createServer } = await import('vite');
	const server = await createServer({
		configFile: join(root, 'web', 'vite.config.ts'),
		logLevel: 'error',
		plugins,
		server: { port: 0, host: '127.0.0.1', hmr: false, watch: null },
	});
	await server.listen();
	return { url: server.resolvedUrls?.local[0] ?? '', close: () => server.close() };
}
