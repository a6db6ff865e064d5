/** Stock Firefox for tests, by WebDriver BiDi: Playwright drives only a build of its own. */

import { type ChildProcess, spawn } from 'node:child_process';
import type { Readable } from 'node:stream';
import puppeteer, { type Browser } from 'puppeteer-core';
import { FIREFOX_PREFERENCES, installed } from '../../../web/tools/measure/launch.mjs';

export interface Firefox {
	browser: Browser;
	close(): Promise<void>;
}

/** Reason why Firefox cannot be tested here; undefined where it can. */
export function missing(): string | undefined {
	if (!installed('firefox')) return 'no Firefox found';
	// Headless Firefox has no WebGL2.
	if (process.platform === 'linux' && !hasScreen() && !installed('Xvfb')) return 'no screen, and no Xvfb found';
	return undefined;
}

const hasScreen = () => Boolean(process.env.DISPLAY || process.env.WAYLAND_DISPLAY);

/** Virtual screen of a number that is free. */
async function screen(): Promise<{ name: string; server: ChildProcess }> {
	const args = ['-displayfd', '3', '-screen', '0', '1280x1024x24', '-nolisten', 'tcp'];
	const server = spawn('Xvfb', args, { stdio: ['ignore', 'ignore', 'ignore', 'pipe'] });
	const name = await new Promise<string>((resolve, reject) => {
		(server.stdio[3] as Readable).once('data', (number) => resolve(`:${String(number).trim()}`));
		server.once('error', reject);
		server.once('exit', (code) => reject(new Error(`Xvfb ended with ${code}`)));
	});
	return { name, server };
}

export async function launchFirefox(): Promise<Firefox> {
	const virtual = process.platform === 'linux' && !hasScreen() ? await screen() : undefined;
	const browser = await puppeteer.launch({
		browser: 'firefox',
		executablePath: installed('firefox') ?? '',
		headless: false,
		env: { ...process.env, ...(virtual && { DISPLAY: virtual.name }), MOZ_CRASHREPORTER_DISABLE: '1' },
		extraPrefsFirefox: FIREFOX_PREFERENCES,
		defaultViewport: { width: 400, height: 300 },
		protocolTimeout: 120_000,
	});
	return {
		browser,
		async close() {
			await browser.close();
			virtual?.server.kill();
		},
	};
}
