import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build, type Plugin } from 'vite';
import { barePlugin, wholePlugin } from '../../web/tools/site/plugins.mjs';
import { serve as serveSite } from '../../web/tools/site/vite.mjs';

const TYPES: Record<string, string> = {
	'.html': 'text/html; charset=utf-8',
	'.js': 'text/javascript',
	'.css': 'text/css',
	'.svg': 'image/svg+xml',
	'.woff2': 'font/woff2',
};

/** Builds the modules that run inside a page, each with its exports: a hundred sources take longer to load than to run. */
async function buildModules(dist: string): Promise<void> {
	const folder = fileURLToPath(new URL('inPage', import.meta.url));
	const files = readdirSync(folder).filter((name) => name.endsWith('.ts'));
	await build({
		configFile: false,
		root: folder,
		logLevel: 'error',
		plugins: [wholePlugin(), barePlugin()],
		build: {
			outDir: join(dist, 'inPage'),
			minify: false,
			rolldownOptions: {
				input: Object.fromEntries(files.map((name) => [basename(name, '.ts'), join(folder, name)])),
				preserveEntrySignatures: 'strict',
				output: { entryFileNames: '[name].js' },
			},
		},
	});
}

/** The built pages and what belongs to them, in front of everything else; `sources.html` is the demo from its sources. */
const builtPages = (dist: string): Plugin => ({
	name: 'furbake-built-pages',
	configureServer({ middlewares }) {
		middlewares.use((request, response, next) => {
			const { pathname, search } = new URL(request.url ?? '/', 'http://localhost');
			if (pathname === '/sources.html') request.url = `/index.html${search}`;
			const path = pathname === '/' ? '/index.html' : pathname;
			const file = join(dist, decodeURIComponent(path));
			const built = /^\/((assets|inPage)\/.+|fur-view\.js|[\w-]+\.html)$/.test(path);
			if (!built || !statSync(file, { throwIfNoEntry: false })?.isFile()) return next();
			response.setHeader('Content-Type', TYPES[extname(file)] ?? 'application/octet-stream');
			response.end(readFileSync(file));
		});
	},
});

/**
 * Serves what the tests look at: the pages as they are hosted, built once (a page in a hundred modules takes longer to load
 * than to draw), and all sources, for tests of modules by themselves. The address is handed to the workers in FURBAKE_URL.
 *
 * @returns what ends it
 */
export default async function serve(): Promise<() => Promise<void>> {
	const dist = mkdtempSync(join(tmpdir(), 'furbake-pages-'));
	await build({
		configFile: fileURLToPath(new URL('../../web/vite.config.ts', import.meta.url)),
		logLevel: 'error',
		// Models are served as they are.
		build: { outDir: dist, copyPublicDir: false },
	});
	await buildModules(dist);
	const { url, close } = await serveSite([builtPages(dist)]);
	process.env.FURBAKE_URL = url;
	return async () => {
		await close();
		rmSync(dist, { recursive: true, force: true });
	};
}
