import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
	root: at('..'),
	cacheDir: at('../node_modules/.vitest'),
	test: {
		include: ['tests/web/**/*.test.ts'],
		environment: 'node',
		// Bakes of tests keep nothing in the user's cache.
		env: { FURBAKE_CACHE: '' },
		// For a loaded machine; the slowest test takes a second or two.
		testTimeout: 20_000,
	},
});
