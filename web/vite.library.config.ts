/** Library for other apps: an ES module per entry point, with the checker of schemas bundled, three.js external; runs from an import map, too. */
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { licencesPlugin } from './tools/site/licences.mjs';
import { barePlugin } from './tools/site/plugins.mjs';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));

/** Modules of one file each: bundlers of apps leave a file whole. */
const TOGETHER = {
	/** What the plugin needs before it has seen any fur. */
	loader: {
		test: /fur\/(FurLoaderPlugin|format|load\/options|planes\/(GltfFiles|download|furLimits|meshopt)|shells\/parts\/parts)\.ts$/,
		priority: 2,
	},
	/** Code of all fur, with what fins, joints and several furs share with it: one request, and 1.4 kB less through gzip. */
	growFur: { test: /fur\/load\/growFur\.ts$/, priority: 1 },
};

export default defineConfig({
	root: at('.'),
	publicDir: false,
	cacheDir: at('../node_modules/.vite'),
	plugins: [barePlugin(), licencesPlugin()],
	build: {
		outDir: at('../lib'),
		emptyOutDir: true,
		target: 'es2023',
		// Apps minify.
		minify: false,
		lib: { entry: { index: at('fur/index.ts'), reference: at('fur/reference.ts') }, formats: ['es'] },
		rolldownOptions: {
			external: /^three(\/|$)/,
			output: {
				chunkFileNames: ({ name, isDynamicEntry }) => (isDynamicEntry || name in TOGETHER ? `${name}.js` : 'shared.js'),
				codeSplitting: { groups: Object.entries(TOGETHER).map(([name, group]) => ({ name, ...group })) },
			},
		},
	},
});
