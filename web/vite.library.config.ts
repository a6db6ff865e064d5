/** The library for other apps: one ES module, three.js beside it. Its two small readers are in it, so that it runs from an import map, too. */
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
	root: at('.'),
	publicDir: false,
	cacheDir: at('../node_modules/.vite'),
	build: {
		outDir: at('../lib'),
		emptyOutDir: true,
		target: 'es2023',
		// Apps minify.
		minify: false,
		license: { fileName: 'licenses.md' },
		lib: { entry: at('fur/index.ts'), formats: ['es'], fileName: 'index' },
		rolldownOptions: { external: /^three(\/|$)/ },
	},
});
