import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { lesson } from './tools/lesson.mjs';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
	root: at('.'),
	base: './',
	publicDir: at('../public'),
	cacheDir: at('../node_modules/.vite'),
	// Pages, no single-page fallback: a missing file is a 404 here as on any static host.
	appType: 'mpa',
	plugins: [lesson()],
	server: {
		// The JSON schema lives in the baker wing.
		fs: { allow: [at('.'), at('../node_modules'), at('../baker/furbake/asset/schema'), at('../tests')] },
	},
	// Named beforehand: otherwise the first visit of a fresh clone finds them one by one and reloads.
	optimizeDeps: {
		include: [
			'@cfworker/json-schema',
			'fast-png',
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
		rolldownOptions: { input: [at('index.html'), at('learn.html'), at('bench.html')] },
		// three.js alone is larger than the default limit.
		chunkSizeWarningLimit: 1200,
	},
});
