/** Poorer GPUs: what they lack is done without, what they cannot hold is told. */

import { expect, frames, open, state, test } from '../harness.ts';
import { shrinkPicture, watchGpu } from '../inPage/gpu.ts';
import { calm, loseContext, middle, psnr, shot } from '../robust.ts';

test.use({ viewport: { width: 120, height: 96 } });

const floats = ['EXT_color_buffer_float', 'EXT_color_buffer_half_float'];

test('without float targets the fur shows in eight bits', async ({ page, browser, watch }) => {
	await open(page, calm);
	const best = await shot(page);
	const context = await browser.newContext({ viewport: page.viewportSize() });
	const poor = await context.newPage();
	poor.on('console', (message) => {
		if (['error', 'warning'].includes(message.type())) watch.complaints.push(message.text());
	});
	await watchGpu(poor, floats);
	await open(poor, calm);
	expect(await state(poor)).toBe('ready');
	const eight = await shot(poor);
	expect(middle(eight).spread).toBeGreaterThan(2);
	expect(psnr(best, eight)).toBeGreaterThan(20);
	expect(psnr(best, eight)).toBeLessThan(Number.POSITIVE_INFINITY);
	await loseContext(poor);
	expect(psnr(eight, await shot(poor))).toBeGreaterThan(45);
	await context.close();
	// three's own word about a table of its skin's shader is all that is allowed.
	expect(watch.complaints.filter((text) => !/EXT_color_buffer_float extension not supported/.test(text))).toEqual([]);
	watch.complaints.length = 0;
});

test('without timer and anisotropy everything else is there', async ({ page }) => {
	await watchGpu(page, ['EXT_disjoint_timer_query_webgl2', 'EXT_texture_filter_anisotropic']);
	await open(page, '?model=sphere&shells=2&details=1');
	await expect(page.locator('#overlay')).toContainText(/\d+ draw calls/);
	await expect(page.locator('#overlay canvas')).toHaveCount(2);
	await frames(page, 30);
	expect(middle(await shot(page)).spread).toBeGreaterThan(1);
	expect(await page.evaluate(() => window.gpu.anisotropy)).toEqual([]);
});

test('planes of shells are filtered along their slant', async ({ page }) => {
	await watchGpu(page);
	await open(page, calm);
	// Coverage and the sphere's colour plane; coefficients of one mip level, planes of fins and everything else are not.
	expect(await page.evaluate(() => window.gpu.anisotropy)).toEqual([2, 2]);
});

for (const [parameter, least, words] of [
	['MAX_ARRAY_TEXTURE_LAYERS', 8, /layers: got \d+ layers, expected at most 8 on this GPU/],
	['MAX_TEXTURE_SIZE', 32, /size: got tiles of 64 × 64 texels, expected at most 32 × 32 on this GPU/],
] as const) {
	test(`an asset beyond ${parameter} gets one clear sentence, and the old model stays`, async ({ page }) => {
		await page.setViewportSize({ width: 900, height: 500 });
		await shrinkPicture(page, 100, 75);
		await watchGpu(page);
		await open(page, '?model=sphere&shells=4&still=1&light=-.8,.5,.3');
		const before = await page.locator('#picture').screenshot();
		await page.evaluate(([name, value]) => Object.assign(window.gpu.parameters, { [name]: value }), [
			parameter,
			least,
		] as const);
		await page.getByRole('combobox', { name: 'Model' }).selectOption('Torus');
		await expect(page.getByRole('status')).toContainText('Torus cannot be shown', { ignoreCase: true });
		await expect(page.getByRole('status')).toContainText(words);
		await expect(page.locator('.notice')).toHaveCount(1);
		await expect.poll(() => state(page)).toBe('ready');
		await expect(page.getByRole('combobox', { name: 'Model' })).toHaveValue('Sphere');
		expect(psnr(before, await page.locator('#picture').screenshot())).toBeGreaterThan(45);
	});
}
