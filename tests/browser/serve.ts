import { fileURLToPath } from 'node:url';
import { createServer } from 'vite';

/**
 * Serves web/ for the tests as `npm start` does, on a port of its own, and never reloads a page under a test.
 * The address is handed to the workers in FURBAKE_URL; returns what ends it.
 */
export default async function serve(): Promise<() => Promise<void>> {
	const server = await createServer({
		configFile: fileURLToPath(new URL('../../web/vite.config.ts', import.meta.url)),
		logLevel: 'error',
		server: { port: 0, host: '127.0.0.1', hmr: false, watch: null },
	});
	await server.listen();
	process.env.FURBAKE_URL = server.resolvedUrls?.local[0];
	return () => server.close();
}
