/** The picture's size: as the window, the layout and the screen have it. */

import { expect, frames, open, state, test } from '../harness.ts';
import { shrinkPicture } from '../inPage/gpu.ts';
import { calm, canvasWidth, middle, psnr, restyle, shot } from '../robust.ts';

test.use({ viewport: { width: 200, height: 160 } });

test('the picture follows the window, the layout and the pixels of the screen', async ({ page }) => {
	await open(page, calm);
	expect(await canvasWidth(page)).toBe(200);
	await page.setViewportSize({ width: 240, height: 160 });
	await expect.poll(() => canvasWidth(page)).toBe(240);
	await restyle(page, '#picture { width: 50% !important }');
	await expect.poll(() => canvasWidth(page)).toBe(120);
	await frames(page);
	expect(middle(await page.locator('#picture').screenshot()).spread).toBeGreaterThan(2);

	const devtools = await page.context().newCDPSession(page);
	const screen = async (deviceScaleFactor: number) => {
		const metrics = { width: 240, height: 160, deviceScaleFactor, mobile: false };
		await devtools.send('Emulation.setDeviceMetricsOverride', metrics);
		// A page that draws nothing new hears of it with the next picture that is taken of it.
		await devtools.send('Page.captureScreenshot');
	};
	await screen(2);
	await expect.poll(() => canvasWidth(page)).toBe(240);
	await screen(1.5);
	await expect.poll(() => canvasWidth(page)).toBe(180);
	await screen(3);
	await expect.poll(() => canvasWidth(page), 'no more than two pixels per CSS pixel').toBe(240);
	expect(await state(page)).toBe('ready');
});

test('a canvas without size is no error, and comes back', async ({ page }) => {
	await open(page, calm);
	const before = await shot(page);
	for (const hidden of ['display: none', 'width: 0', 'height: 0']) {
		await restyle(page, `#picture { ${hidden} !important }`);
		await page.keyboard.press('ArrowRight');
		await page.keyboard.press('ArrowLeft');
		await frames(page, 3);
		await restyle(page, '');
		await frames(page, 4);
		expect(psnr(before, await shot(page)), hidden).toBeGreaterThan(45);
	}
});

test('a page that opens without size shows its picture when it gets one', async ({ page }) => {
	await open(page, calm);
	const early = await shot(page);
	await shrinkPicture(page, 0, 0);
	await open(page, calm);
	expect(await state(page)).toBe('ready');
	await restyle(page, '');
	await expect.poll(async () => middle(await shot(page)).spread).toBeGreaterThan(2);
	await frames(page, 3);
	expect(psnr(early, await shot(page))).toBeGreaterThan(45);
});
