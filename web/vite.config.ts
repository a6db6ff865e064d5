import { readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { lesson } from './tools/lesson.mjs';
import { fontsPlugin, headersPlugin, shaderPlugin, sharePlugin } from './tools/plugins.mjs';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));
const pages = readdirSync(at('.')).filter((name) => name.endsWith('.html'));

export default defineConfig({
	root: at('.'),
	base: './',
	publicDir: at('../public'),
	cacheDir: at('../node_modules/.vite'),
	// Pages, no single-page fallback: a missing file is a 404 here as on any static host.
	appType: 'mpa',
	// The example reads as it would in another app.
	resolve: { alias: { furbake: at('fur/index.ts') } },
	plugins: [lesson(), shaderPlugin(), fontsPlugin(), headersPlugin(), sharePlugin(process.env.SITE_URL)],
	server: {
		// The JSON schema lives in the baker wing.
		fs: { allow: [at('.'), at('../node_modules'), at('../baker/furbake/asset/schema'), at('../tests')] },
	},
	// Named beforehand: otherwise the first visit of a fresh clone finds them one by one and reloads.
	optimizeDeps: {
		include: [
			'@cfworker/json-schema',
			'fast-png',
			'fflate',
			'lil-gui',
			'stats-gl',
			'three',
			'three/addons/controls/OrbitControls.js',
			'three/addons/loaders/EXRLoader.js',
			'three/addons/lines/Line2.js',
			'three/addons/lines/LineGeometry.js',
			'three/addons/lines/LineMaterial.js',
			'three/addons/loaders/GLTFLoader.js',
			'three/addons/postprocessing/OutputPass.js',
		],
		// Modules of one picture each, fetched when wanted.
		exclude: ['@pmndrs/assets'],
	},
	build: {
		outDir: at('../dist'),
		emptyOutDir: true,
		// Browsers that know light-dark(): what it is rewritten to for older ones takes the root's scheme everywhere, and words
		// over the dark picture would be dark in a light scheme.
		cssTarget: ['chrome123', 'edge123', 'firefox120', 'safari17.5'],
		rolldownOptions: { input: pages.map(at) },
		// The policy allows no fonts nor scripts in data: addresses, and files of their own are kept by browsers.
		assetsInlineLimit: 0,
		// Browsers with WebGL2 that lack it load the same modules, a little later.
		modulePreload: { polyfill: false },
		license: { fileName: 'licenses.md' },
		// three.js alone is larger than the default limit.
		chunkSizeWarningLimit: 1200,
	},
});
