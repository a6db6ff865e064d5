/** Fewer pixels where frames take long; how long they take is told to it, so none is drawn. */

import type { Page } from '@playwright/test';
import { expect, frames, open, test } from '../harness.ts';
import { drawNothing, shrinkPicture, watchGpu } from '../inPage/gpu.ts';
import { calm, canvasWidth } from '../robust.ts';

test.use({ viewport: { width: 100, height: 80 } });

const load = (page: Page, milliseconds: number) =>
	page.evaluate((milliseconds) => {
		window.gpu.time = (width) => milliseconds * (width / 160) ** 2;
	}, milliseconds);

test('draws fewer pixels where frames take long, all of them where nothing moves', async ({ page }) => {
	await page.setViewportSize({ width: 400, height: 300 });
	await shrinkPicture(page, 160, 60);
	await drawNothing(page);
	await watchGpu(page);
	await page.addInitScript(() => {
		window.gpu.time = () => 1;
	});
	await open(page, '?model=sphere&shells=2');
	await expect(page.locator('#overlay')).toContainText('full resolution');
	expect(await canvasWidth(page)).toBe(160);
	await load(page, 24);
	await expect.poll(() => canvasWidth(page)).toBe(113);
	await expect(page.locator('#overlay')).toContainText('71 % resolution');
	await load(page, 5);
	await expect.poll(() => canvasWidth(page)).toBe(160);
	await load(page, 200);
	await expect.poll(() => canvasWidth(page)).toBe(80);
	await page.keyboard.press('ArrowRight');
	await expect.poll(() => canvasWidth(page)).toBe(160);
	await expect(page.locator('#overlay')).toContainText('full resolution');
});

test('leaves pictures alone with still=1', async ({ page }) => {
	await drawNothing(page);
	await watchGpu(page);
	await page.addInitScript(() => {
		window.gpu.time = () => 200;
	});
	await open(page, calm);
	for (let i = 0; i < 40; i++) {
		await page.keyboard.press('ArrowRight');
		await frames(page, 1);
	}
	expect(await canvasWidth(page)).toBe(100);
});

test('waits for a GPU that is behind, and goes on from where the hand is then', async ({ page }) => {
	await drawNothing(page);
	await watchGpu(page);
	await open(page, '?model=sphere&shells=2&light=-.8,.5,.3');
	const light = () => new URL(page.url()).searchParams.get('light');
	const at = light();
	const before = await page.evaluate(() => {
		window.gpu.behind = true;
		return window.gpu.fences;
	});
	for (let i = 0; i < 12; i++) {
		await page.keyboard.press('ArrowRight');
		await frames(page, 1);
	}
	expect(await page.evaluate(() => window.gpu.fences)).toBeLessThanOrEqual(before + 4);
	await page.evaluate(() => {
		window.gpu.behind = false;
	});
	await expect.poll(() => page.evaluate(() => window.gpu.fences)).toBeGreaterThan(before + 8);
	await expect.poll(light).not.toBe(at);
});
