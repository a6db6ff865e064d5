/** The lesson's figures of hair that swings, fur in the wind and wet fur. */

import { expect, open, test } from '../harness.ts';
import { changes, figure, pixels, show } from './figures.ts';

test.use({ viewport: { width: 400, height: 320 } });

test('hair on a spring: the exact step is on the curve however long it is, Euler’s is not', async ({ page }) => {
	await open(page, 'learn.html?still=1&lang=en#swing');
	await show(page, 'spring');
	const off = (way: string) =>
		figure(page, 'spring')
			.locator('.note')
			.evaluate((note, name) => Number((note as HTMLElement).dataset[name]), way);
	const tips = async () =>
		((await figure(page, 'spring').locator('canvas').getAttribute('data-tips')) ?? '').split(',');
	for (const step of ['1/60 s', '1/15 s', '1/2 s']) {
		const slider = figure(page, 'spring').getByLabel('Time step');
		while ((await slider.getAttribute('aria-valuetext')) !== step) await slider.press('ArrowRight');
		expect(await off('exact'), step).toBeLessThan(1e-6);
		expect(await off('euler'), step).toBeGreaterThan(0.3);
	}
	expect(await off('euler')).toBeGreaterThan(100);
	// Nothing moves until it is asked for: pushed to the left, let go, and at rest in the breeze.
	const frames = () => pixels(page, 'spring');
	await frames();
	const before = await tips();
	await frames();
	expect(await tips()).toEqual(before);
	await figure(page, 'spring').locator('canvas').focus();
	for (let i = 0; i < 10; i++) await page.keyboard.press('ArrowLeft');
	const fromRest = async () => (await tips()).slice(0, 2).map((tip) => Math.abs(Number(tip) - 0.1));
	await expect.poll(async () => Math.max(...(await fromRest()))).toBeLessThan(0.02);
});

test('fur bends to the wind, and keeps the lane of a hand', async ({ page }) => {
	await open(page, 'learn.html?still=1&lang=en#swing');
	await show(page, 'wind');
	await changes(page, 'wind', 'no wind', () => figure(page, 'wind').getByRole('slider', { name: 'Wind' }).fill('0'), 1);
	await changes(
		page,
		'wind',
		'a stroke',
		() => figure(page, 'wind').getByRole('button', { name: 'Stroke it' }).click(),
		0.5,
	);
	const drag = async () => {
		const canvas = figure(page, 'wind').locator('canvas');
		await canvas.evaluate((element) => element.scrollIntoView({ block: 'end', behavior: 'instant' }));
		// Figures that are being built beside it move it away from under the hand.
		await pixels(page, 'wind');
		await expect(page.locator('figure[data-state=loading]')).toHaveCount(0);
		const { x = 0, y = 0, width = 0, height = 0 } = (await canvas.boundingBox()) ?? {};
		await page.mouse.move(x + 0.4 * width, y + 0.7 * height);
		await page.mouse.down();
		// Frame by frame: moves within one are a single move.
		for (const way of [0.5, 0.6, 0.7]) {
			await page.mouse.move(x + way * width, y + 0.6 * height);
			await pixels(page, 'wind');
		}
		await page.mouse.up();
	};
	await changes(page, 'wind', 'a drag', drag, 0.3);
});

test('the wetter fur is, the darker, and muddy fur has another colour', async ({ page }) => {
	await open(page, 'learn.html?still=1&lang=en#wet');
	await show(page, 'wet');
	const set = (label: string, to: string) => () => figure(page, 'wet').getByRole('slider', { name: label }).fill(to);
	// The middle of the picture is all fur.
	const bright = async () => {
		const all = await pixels(page, 'wet');
		return all.filter((_, i) => Math.abs((i % 40) - 20) < 4 && Math.abs(i / 40 - 16) < 4).reduce((a, b) => a + b, 0);
	};
	await expect(figure(page, 'wet')).toContainText('50 % moist');
	const half = await bright();
	await changes(page, 'wet', 'soaked', set('Wetness', '1'), 0.5);
	expect(await bright()).toBeLessThan(0.95 * half);
	await expect(figure(page, 'wet')).toContainText('100 % soaked');
	await changes(page, 'wet', 'muddy', set('Dirt', '1'), 0.5);
});

test('a limb whose joint turns has other moments under the lamp, which stays', async ({ page }) => {
	await page.setViewportSize({ width: 900, height: 800 });
	await open(page, 'learn.html?still=1&lang=en#pose');
	await show(page, 'pose');
	const canvas = figure(page, 'pose').locator('canvas');
	const joint = figure(page, 'pose').getByRole('slider', { name: 'Joint' });
	const moments = async () => ((await canvas.getAttribute('data-moments')) ?? '').split(',').map(Number);
	/** By the joint's angle and the lesson's first light. */
	const expected = (degrees: number) => {
		const [angle, size] = [(degrees * Math.PI) / 180, Math.hypot(0.62, 0.62, 0.48)];
		const u = (-0.62 * Math.cos(angle) + 0.62 * Math.sin(angle)) / size;
		const v = -0.48 / size;
		return [u * u, v * v, u * v, u, v, 1].map((value) => expect.closeTo(value, 6));
	};
	for (const degrees of [55, 0, 45, 110]) {
		await joint.fill(String(degrees));
		expect(await moments()).toEqual(expected(degrees));
	}
	await canvas.focus();
	await page.keyboard.press('ArrowRight');
	expect(await moments()).toEqual(expected(105));
	await changes(
		page,
		'pose',
		'a drag',
		async () => {
			const { x = 0, y = 0, width = 0, height = 0 } = (await canvas.boundingBox()) ?? {};
			await page.mouse.move(x + 0.5 * width, y + 0.1 * height);
			await page.mouse.down();
			await page.mouse.move(x + 0.95 * width, y + 0.6 * height);
			await page.mouse.up();
		},
		0.5,
	);
	expect(Number(await joint.inputValue())).toBeLessThan(20);
	expect(await moments()).toEqual(expected(Number(await joint.inputValue())));
	await expect(figure(page, 'pose')).toContainText(/L = \d\.\d\d before, \d\.\d\d now/);
});
