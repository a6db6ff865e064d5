import { fileURLToPath } from 'node:url';
import { defineConfig } from '@playwright/test';
import { browserArgs, findBrowser } from '../../web/tools/browser.mjs';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));
const executablePath = process.env.FURBAKE_CHROMIUM ?? (await findBrowser());
/** Text and boxes are painted without shaders, which a software rasteriser compiles for every page anew. */
const plainPages = '--disable-gpu-rasterization';
const launch = (...more: string[]) => ({
	launchOptions: { ...(executablePath ? { executablePath } : {}), args: [...browserArgs, plainPages, ...more] },
});

/** Bakes of tests keep nothing in the user's cache. */
process.env.FURBAKE_CACHE = '';

export default defineConfig({
	testDir: at('.'),
	outputDir: at('../../node_modules/.cache/furbake/browser-tests'),
	globalSetup: at('serve.ts'),
	// A software rasteriser uses every core by itself, pages that load and compile do not.
	workers: 2,
	fullyParallel: false,
	// Proofs of minutes: `npm test -- --all`.
	...(process.env.FURBAKE_TEST_ALL !== '1' && { grepInvert: /@long/ }),
	forbidOnly: Boolean(process.env.CI),
	// A machine may be several times as slow as another, and its software rasteriser with it.
	timeout: 240_000,
	// A browser that hangs says nothing of the page; the last line of the run tells what passed at the second try.
	retries: 1,
	expect: { timeout: 90_000 },
	reporter: 'list',
	use: {
		// Every pixel of a frame is drawn by the processor.
		viewport: { width: 240, height: 180 },
		screenshot: 'off',
		trace: 'off',
	},
	projects: [
		{ name: 'webgl', testIgnore: ['**/without-*.spec.ts', '**/steady.spec.ts', '**/firefox/**'], use: launch() },
		{ name: 'without', testMatch: '**/without-*.spec.ts', use: launch('--disable-3d-apis') },
		{ name: 'firefox', testMatch: '**/firefox/*.spec.ts' },
		// Counts bytes per frame: has the machine to itself.
		{ name: 'steady', testMatch: '**/steady.spec.ts', dependencies: ['webgl', 'without'], use: launch() },
	],
});
