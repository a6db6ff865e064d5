/**
 * Browser for tests and measurements: an installed Chromium or Chrome, else Playwright's own, installed on demand.
 * As a command it prints the path of the installed one, or fails.
 */
import { existsSync } from 'node:fs';
import { delimiter, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { ask, Failure, root, runAside, say, windows } from './process.mjs';

/** Switches for software rendering that is equal everywhere, and for silence. */
export const browserArgs = [
	'--headless=new',
	'--no-sandbox',
	'--use-angle=swiftshader',
	'--enable-unsafe-swiftshader',
	'--disable-quic',
	'--no-first-run',
	'--disable-background-networking',
	'--disable-component-update',
	'--disable-sync',
];

function candidates() {
	// The shell has no window: a page costs it a second less.
	const names = ['chromium-headless-shell', 'chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable'];
	const folders = (process.env.PATH ?? '').split(delimiter).filter(Boolean);
	const programs = ['PROGRAMFILES', 'PROGRAMFILES(X86)', 'LOCALAPPDATA'].map((name) => process.env[name] ?? '');
	return [
		process.env.FURBAKE_CHROMIUM ?? '',
		...names.flatMap((name) => folders.map((folder) => join(folder, name))),
		'/Applications/Google Chrome.app/Contents/MacOS/Google Chrome',
		'/Applications/Chromium.app/Contents/MacOS/Chromium',
		...programs.filter(Boolean).map((folder) => join(folder, 'Google', 'Chrome', 'Application', 'chrome.exe')),
	].filter((path) => path !== '' && existsSync(path));
}

/** @returns {Promise<string | undefined>} path of an installed browser that starts */
export async function findBrowser() {
	for (const path of candidates()) {
		// A package's stub (Ubuntu's snap) exists but does not start; on Windows --version opens a window.
		if (windows || (await ask(path, ['--version'])) !== undefined) return path;
	}
	return undefined;
}

/** @returns {Promise<string>} path of a browser, installed where none was found; needs `ensureNode` */
export async function ensureBrowser() {
	const found = await findBrowser();
	if (found) return found;
	const { chromium } = await import('@playwright/test');
	if (!existsSync(chromium.executablePath())) {
		say("no Chromium or Chrome found: installing Playwright's own");
		const cli = join(root, 'node_modules', '@playwright', 'test', 'cli.js');
		const code = await runAside(process.execPath, [cli, 'install', '--no-shell', 'chromium']);
		if (code !== 0)
			throw new Failure('no browser for the tests: install Chromium or Chrome, or set FURBAKE_CHROMIUM to its path');
	}
	return chromium.executablePath();
}

/**
 * Opens an empty page with a module, whose exports are the global `loaded`.
 *
 * @param {import('@playwright/test').Page} page
 * @param {string} site where web/ is served, with a slash at its end
 * @param {string} module its address there
 */
export async function openModule(page, site, module) {
	const body = `<!doctype html><title>${module}</title><link rel="icon" href="data:,">
		<script type="module">import * as loaded from '${module}'; window.loaded = loaded;</script>`;
	await page.route('**/module.html', (route) => route.fulfill({ contentType: 'text/html', body }));
	await page.goto(`${site}module.html`);
	await page.waitForFunction(() => 'loaded' in globalThis);
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
	const path = await findBrowser();
	if (path) console.log(path);
	else process.exitCode = 1;
}
