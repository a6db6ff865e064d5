/** What the browser tests share: a page that is watched, and pictures that are measured. */

import { test as base, expect, type Locator, type Page } from '@playwright/test';
import { decode } from 'fast-png';

export { expect };

/** Where the site under test is served; it ends in a slash. */
export const site = process.env.FURBAKE_URL ?? '';

export interface Watch {
	/** errors and warnings of the console, uncaught exceptions */
	complaints: string[];
	/** addresses of all requests */
	requests: string[];
}

/** Remark of a browser's driver on pages that read pixels back, as measurements do. */
const STALL = /GL Driver Message \(OpenGL, Performance, .*GPU stall due to ReadPixels/;

interface Fixtures {
	/** Every test fails by a complaint in it, unless it takes them away. */
	watch: Watch;
}

export const test = base.extend<Fixtures>({
	watch: [
		async ({ page }, use) => {
			const watch: Watch = { complaints: [], requests: [] };
			page.on('console', (message) => {
				if (!['error', 'warning', 'assert'].includes(message.type())) return;
				if (!STALL.test(message.text())) watch.complaints.push(message.text());
			});
			page.on('pageerror', (error) => watch.complaints.push(`uncaught: ${error.message}`));
			page.on('request', (request) => watch.requests.push(request.url()));
			await use(watch);
			expect(watch.complaints).toEqual([]);
		},
		{ auto: true },
	],
});

/** The page's own word on what it shows: loading, ready or failed. */
export function state(page: Page): Promise<string | undefined> {
	return page.evaluate(() => document.documentElement.dataset.state);
}

/** Opens the demo and waits until it shows its first whole picture, or fails. */
export async function open(page: Page, query: string, address = site): Promise<void> {
	await page.goto(address + query);
	await page.waitForFunction(() => document.documentElement.dataset.state !== 'loading', null, { timeout: 120_000 });
}

/** A parameter of the address, when the page has written its last word there. */
export async function settled(page: Page, name: string): Promise<string | null> {
	let before: string | undefined;
	await expect(async () => {
		await frames(page); // it writes what its frames have found
		const now = page.url();
		const same = now === before;
		before = now;
		expect(same).toBe(true);
	}).toPass({ intervals: [900] });
	return new URL(page.url()).searchParams.get(name);
}

/**
 * Waits for frames of the page, each drawn to its end: else the next would wait for it.
 *
 * @param count of them; two show all that was asked for before
 */
export const frames = (page: Page, count = 2) =>
	page.evaluate(
		(count) =>
			new Promise<void>((resolve) => {
				const gl = document.querySelector<HTMLCanvasElement>('canvas#picture')?.getContext('webgl2');
				const next = (left: number) => {
					// Browsers do not wait in finish().
					gl?.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
					if (left > 0) requestAnimationFrame(() => next(left - 1));
					else resolve();
				};
				next(count);
			}),
		count,
	);

export interface Picture {
	width: number;
	height: number;
	/** per pixel, 0..255, mean of the channels; row by row from the top */
	brightness: Float32Array;
}

/** What a page, or an element of it, looks like. */
export async function picture(shown: Page | Locator): Promise<Picture> {
	await frames('page' in shown ? shown.page() : shown);
	const { width, height, data, channels } = decode(await shown.screenshot());
	const brightness = new Float32Array(width * height);
	for (let i = 0; i < brightness.length; i++) {
		const [r = 0, g = 0, b = 0] = data.subarray(i * channels, i * channels + 3);
		brightness[i] = (r + g + b) / 3;
	}
	return { width, height, brightness };
}

/** Mean brightness of the left and the right half, 0..255. */
export function halves({ width, height, brightness }: Picture): [left: number, right: number] {
	const sums: [number, number] = [0, 0];
	brightness.forEach((value, i) => {
		sums[i % width < width / 2 ? 0 : 1] += value;
	});
	return [sums[0] / (width * height * 0.5), sums[1] / (width * height * 0.5)];
}

/** Mean absolute difference of two pictures of one size, 0..255. */
export function difference(a: Picture, b: Picture): number {
	let sum = 0;
	a.brightness.forEach((value, i) => {
		sum += Math.abs(value - (b.brightness[i] ?? 0));
	});
	return sum / a.brightness.length;
}
