/** Library for other apps: an ES module per entry point, with the checker of schemas bundled, three.js external; runs from an import map, too. */
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { licencesPlugin } from './tools/site/licences.mjs';
import { barePlugin } from './tools/site/plugins.mjs';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));

/** What the plugin needs before it has seen any fur. */
const LOADER =
	/fur\/(FurLoaderPlugin|format|load\/options|planes\/(GltfFiles|download|furLimits|meshopt)|shells\/parts\/parts)\.ts$/;

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
				chunkFileNames: ({ name, isDynamicEntry }) =>
					isDynamicEntry || name === 'loader' ? `${name}.js` : 'shared.js',
				// Apart from what the plugin fetches only where there is fur: bundlers of apps leave a file whole.
				codeSplitting: { groups: [{ name: 'loader', test: LOADER }] },
			},
		},
	},
});
