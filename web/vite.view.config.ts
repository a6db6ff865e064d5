/** `<fur-view>`: one file with three.js inside, for pages that have nothing else. */
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { licencesPlugin } from './tools/site/licences.mjs';
import { barePlugin, wholePlugin } from './tools/site/plugins.mjs';
import { decoderPlugin } from './tools/site/view.mjs';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
	root: at('.'),
	publicDir: false,
	cacheDir: at('../node_modules/.vite'),
	plugins: [wholePlugin(), barePlugin(), decoderPlugin(), licencesPlugin('fur-view.licenses.md')],
	build: {
		outDir: at('../lib'),
		emptyOutDir: false,
		target: ['chrome123', 'edge123', 'firefox120', 'safari17.5'],
		minify: true,
		modulePreload: false,
		// three.js is inside.
		chunkSizeWarningLimit: 1200,
		// No library of vite's: those keep their spaces.
		rolldownOptions: {
			input: { 'fur-view': at('view/index.ts') },
			preserveEntrySignatures: 'strict',
			output: { entryFileNames: '[name].js', codeSplitting: false },
		},
	},
});
