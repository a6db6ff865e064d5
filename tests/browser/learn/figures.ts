/** Figures of the lesson, as its tests look at them. */

import type { Page } from '@playwright/test';
import { expect, open } from '../harness.ts';

export const figure = (page: Page, name: string) => page.locator(`figure[data-figure="${name}"]`);

/** Opens the lesson with these figures alone. @param at hash of the address */
export async function openWith(page: Page, names: string, at = '', query = 'still=1&lang=en'): Promise<void> {
	await page.route(/\/assets\/(en|index)-[\w-]+\.js$/, async (route) => {
		const response = await route.fetch();
		const others = new RegExp(`data-figure="(?!(?:${names})")`, 'g');
		await route.fulfill({ response, body: (await response.text()).replaceAll(others, 'data-left-out="') });
	});
	await open(page, `learn.html?${query}${at}`);
	await expect(page.locator('figure[data-left-out]')).not.toHaveCount(0);
}

/** Brings a figure near and waits until it has been drawn. */
export async function show(page: Page, name: string): Promise<void> {
	await figure(page, name).evaluate((element) => element.scrollIntoView({ block: 'start', behavior: 'instant' }));
	await expect(figure(page, name)).toHaveAttribute('data-state', 'ready');
}

/** Pixels of a canvas when the next frame has been drawn, as one number per pixel. */
export function pixels(page: Page, name: string, nth = 0): Promise<number[]> {
	return figure(page, name)
		.locator('canvas')
		.nth(nth)
		.evaluate(async (canvas: HTMLCanvasElement) => {
			for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
			const small = new OffscreenCanvas(40, 30).getContext('2d', { willReadFrequently: true });
			small?.drawImage(canvas, 0, 0, 40, 30);
			const { data = [] } = small?.getImageData(0, 0, 40, 30) ?? {};
			return Array.from(
				{ length: 1200 },
				(_, i) => (data[4 * i] ?? 0) + (data[4 * i + 1] ?? 0) + (data[4 * i + 2] ?? 0),
			);
		});
}

export function apart(a: number[], b: number[]): number {
	return a.reduce((sum, value, i) => sum + Math.abs(value - (b[i] ?? 0)), 0) / a.length / 3;
}

/** Does something by which a figure's first picture has to change. */
export async function changes(page: Page, name: string, what: string, change: () => Promise<void>, least: number) {
	const before = await pixels(page, name);
	await change();
	await expect.poll(async () => apart(before, await pixels(page, name)), what).toBeGreaterThan(least);
}
