/** Library for other apps: an ES module per entry point, with the checker of schemas bundled, three.js external; runs from an import map, too. */
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { licencesPlugin } from './tools/site/licences.mjs';
import { shaderPlugin } from './tools/site/plugins.mjs';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
	root: at('.'),
	publicDir: false,
	cacheDir: at('../node_modules/.vite'),
	plugins: [shaderPlugin(), licencesPlugin()],
	build: {
		outDir: at('../lib'),
		emptyOutDir: true,
		target: 'es2023',
		// Apps minify.
		minify: false,
		lib: { entry: { index: at('fur/index.ts'), reference: at('fur/reference.ts') }, formats: ['es'] },
		rolldownOptions: {
			external: /^three(\/|$)/,
			output: { chunkFileNames: ({ name, isDynamicEntry }) => (isDynamicEntry ? `${name}.js` : 'shared.js') },
		},
	},
});
