import { readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { guidePlugin } from './tools/site/guide.mjs';
import { lesson } from './tools/site/lesson.mjs';
import { licencesPlugin } from './tools/site/licences.mjs';
import { barePlugin, fontsPlugin, headersPlugin, sharePlugin, wholePlugin } from './tools/site/plugins.mjs';
import { viewPlugin } from './tools/site/view.mjs';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));
const pages = readdirSync(at('.')).filter((name) => name.endsWith('.html'));

export default defineConfig({
	root: at('.'),
	base: './',
	publicDir: at('../public'),
	cacheDir: at('../node_modules/.vite'),
	// Pages, no single-page fallback: a missing file is a 404 here as on any static host.
	appType: 'mpa',
	// The example imports the library as another app would.
	resolve: { alias: { 'furbake/reference': at('fur/reference.ts'), furbake: at('fur/index.ts') } },
	plugins: [
		lesson(),
		guidePlugin(),
		wholePlugin(/checks|environmentMap/),
		barePlugin(),
		fontsPlugin(),
		licencesPlugin(),
		viewPlugin(),
		headersPlugin(),
		sharePlugin(process.env.SITE_URL),
	],
	server: {
		// The JSON schema lives in the baker wing.
		fs: { allow: [at('.'), at('../node_modules'), at('../baker/furbake/asset/schema'), at('../tests')] },
	},
	// Listed in advance: otherwise the first visit of a fresh clone finds them one by one and reloads.
	optimizeDeps: {
		include: [
			'@cfworker/json-schema',
			'fast-png',
			'fflate',
			'lil-gui',
			'stats-gl',
			'three',
			'three/addons/controls/OrbitControls.js',
			'three/addons/libs/meshopt_decoder.module.js',
			'three/addons/loaders/EXRLoader.js',
			'three/addons/lines/Line2.js',
			'three/addons/lines/LineGeometry.js',
			'three/addons/lines/LineMaterial.js',
			'three/addons/loaders/GLTFLoader.js',
			'three/addons/postprocessing/OutputPass.js',
			'three/addons/utils/SkeletonUtils.js',
		],
		// Modules of one picture each, fetched on demand.
		exclude: ['@pmndrs/assets'],
	},
	build: {
		outDir: at('../dist'),
		emptyOutDir: true,
		// Browsers that know light-dark(): its replacement for older ones takes the root's scheme everywhere, and text over the
		// dark picture would be dark in a light scheme.
		cssTarget: ['chrome123', 'edge123', 'firefox120', 'safari17.5'],
		rolldownOptions: { input: pages.map(at) },
		// The policy allows no fonts nor scripts in data: addresses, and browsers cache separate files.
		assetsInlineLimit: 0,
		// Browsers with WebGL2 that lack it load the same modules, a little later.
		modulePreload: { polyfill: false },
		// three.js alone is larger than the default limit.
		chunkSizeWarningLimit: 1200,
	},
});
