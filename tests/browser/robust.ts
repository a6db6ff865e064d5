/** What tests of a page under stress share. */

import type { Page } from '@playwright/test';
import { decode } from 'fast-png';
import { expect, frames, state } from './harness.ts';

/** A light model, lit from the side. */
export const calm = '?model=sphere&shells=6&still=1&ui=0&light=-.8,.5,.3';

/** A picture of the page, with what was asked for before. */
export async function shot(page: Page): Promise<Buffer> {
	await frames(page);
	return page.screenshot();
}

/** Decibels between two pictures of one size; Infinity for the same. */
export function psnr(a: Buffer, b: Buffer): number {
	const [one, other] = [decode(a), decode(b)];
	expect([other.width, other.height]).toEqual([one.width, one.height]);
	let sum = 0;
	one.data.forEach((value, i) => {
		sum += (value - (other.data[i] ?? 0)) ** 2;
	});
	return 10 * Math.log10(255 ** 2 / (sum / one.data.length));
}

/** Mean and spread of the brightness of the picture's middle: a blank one has none. */
export function middle(png: Buffer): { mean: number; spread: number } {
	const { width, height, channels, data } = decode(png);
	const values: number[] = [];
	for (let y = Math.round(height * 0.4); y < height * 0.6; y++)
		for (let x = Math.round(width * 0.4); x < width * 0.6; x++) values.push(data[(y * width + x) * channels] ?? 0);
	const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
	return { mean, spread: Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / values.length) };
}

export const canvasWidth = (page: Page) => page.evaluate(() => document.querySelector('canvas')?.width);

/** Takes the context away and gives it back. */
export async function loseContext(page: Page): Promise<void> {
	await page.evaluate(() => {
		const gl = document.querySelector('canvas')?.getContext('webgl2');
		const switched = gl?.getExtension('WEBGL_lose_context');
		Object.assign(window, { giveBack: () => switched?.restoreContext() });
		switched?.loseContext();
	});
	await expect.poll(() => state(page)).toBe('loading');
	await page.waitForTimeout(300);
	expect(await state(page)).toBe('loading');
	await page.evaluate(() => (window as unknown as { giveBack(): void }).giveBack());
	await expect.poll(() => state(page)).toBe('ready');
}

/** Styles besides the page's own, in place of those before. */
export const restyle = (page: Page, css: string) =>
	page.evaluate((css) => {
		// No element: the page's policy allows none.
		const sheet = new CSSStyleSheet();
		sheet.replaceSync(css);
		document.adoptedStyleSheets = [sheet];
	}, css);

/** Frames as fast as they can be drawn, 16 ms apart by the clock that they are told. */
export async function hasten(page: Page): Promise<void> {
	await page.addInitScript(() => {
		const { port1, port2 } = new MessageChannel();
		let now = performance.now();
		let waiting: FrameRequestCallback[] = [];
		let due: FrameRequestCallback[] = [];
		port1.onmessage = () => {
			[due, waiting] = [waiting, due];
			now += 16;
			for (const callback of due) callback(now);
			due.length = 0;
		};
		window.requestAnimationFrame = (callback) => {
			if (waiting.push(callback) === 1) port2.postMessage(0);
			return 0;
		};
	});
}
