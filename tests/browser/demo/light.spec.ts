import type { Page } from '@playwright/test';
import { difference, expect, halves, open, picture, settled, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';

const light = (page: Page) => new URL(page.url()).searchParams.get('light')?.split(',').map(Number) ?? [];

test('between two opposite lights the brightness of the halves swaps', async ({ page, watch }) => {
	await open(page, '?model=bunny&still=1&ui=0&light=1,.3,.2');
	const [leftA, rightA] = halves(await picture(page));
	await open(page, '?model=bunny&still=1&ui=0&light=-1,.3,.2');
	const [leftB, rightB] = halves(await picture(page));
	expect(rightA).toBeGreaterThan(leftA + 1);
	expect(leftB).toBeGreaterThan(rightB + 1);
	expect(rightA - leftA + leftB - rightB).toBeGreaterThan(5);
	const hosts = new Set(watch.requests.filter((url) => !url.startsWith('data:')).map((url) => new URL(url).host));
	expect([...hosts]).toEqual([new URL(page.url()).host]);
});

test('a picture with still=1 does not change by itself', async ({ page }) => {
	await open(page, '?model=torus-512&still=1&ui=0');
	const before = await picture(page);
	await page.waitForTimeout(600);
	expect(difference(before, await picture(page))).toBe(0);
});

test('a black eye is dark with one bright glint, with the lamp behind it', async ({ page }) => {
	const near = 'camera=20,10,.08&target=-.593,.468,.732';
	await open(page, `?model=bunny&colour=050505,0a0a0a&light=.3,.5,-.9&shells=4&${near}&still=1&ui=0`);
	const { width, height, brightness } = await picture(page);
	// Within the eye, which is a quarter of the picture wide.
	const seen = brightness.filter((_, i) => {
		const [x, y] = [(i % width) / width - 0.37, (Math.floor(i / width) - 0.43 * height) / width];
		return Math.hypot(x, y) < 0.09;
	});
	seen.sort();
	expect(seen[seen.length >> 1]).toBeLessThan(14);
	expect(seen.at(-1)).toBeGreaterThan(180);
});

test('the light drifts until somebody takes it', async ({ page }) => {
	await open(page, '?model=sphere&shells=4');
	const before = await picture(page);
	await page.waitForTimeout(1500);
	expect(difference(before, await picture(page))).toBeGreaterThan(0.05);
	expect(light(page)).toEqual([]);
	await page.keyboard.press('ArrowRight');
	await expect.poll(() => light(page)).toHaveLength(3);
	const taken = await settled(page, 'light');
	await page.waitForTimeout(1200);
	expect(await settled(page, 'light')).toBe(taken);
});

test('the light stands still where reduced motion is asked for', async ({ page }) => {
	await page.emulateMedia({ reducedMotion: 'reduce' });
	await open(page, '?model=sphere&shells=4&ui=0');
	const before = await picture(page);
	await page.waitForTimeout(800);
	expect(difference(before, await picture(page))).toBe(0);
});

test('arrow keys move the light, and the picture and the address with it', async ({ page }) => {
	await open(page, '?model=sphere&shells=4&still=1&ui=0&light=0,0,1');
	const before = await picture(page);
	for (let i = 0; i < 5; i++) await page.keyboard.press('Shift+ArrowRight');
	await expect.poll(() => light(page)[0]).toBeCloseTo(Math.sin(Math.PI / 3), 2);
	await page.keyboard.press('ArrowUp');
	await expect.poll(() => light(page)[1]).toBeCloseTo(Math.sin((4 * Math.PI) / 180), 2);
	expect(difference(before, await picture(page))).toBeGreaterThan(1);
});

test('a drag takes the lamp along, over the rim and behind the model', async ({ page }) => {
	await open(page, '?model=sphere&shells=4&still=1&ui=0&light=0,.5,1&camera=0,0,1');
	const { width, height } = page.viewportSize() ?? { width: 0, height: 0 };
	const before = await picture(page);
	await page.mouse.move(width / 2, height / 2);
	await page.mouse.down();
	await expect.poll(() => light(page)).toEqual([0, 0, 1]);
	await page.mouse.move(width / 2 + height / 4, height / 2, { steps: 4 });
	await expect.poll(() => light(page)[0]).toBeGreaterThan(0.3);
	expect(light(page)[2]).toBeGreaterThan(0.3);
	expect(difference(before, await picture(page))).toBeGreaterThan(1);
	await page.mouse.move(width - 2, height / 2, { steps: 4 });
	await expect.poll(() => light(page)[2]).toBeLessThan(-0.3);
	await page.mouse.up();
	const left = await settled(page, 'light');
	await page.mouse.move(width / 2, height / 2);
	expect(await settled(page, 'light')).toBe(left);
});

test('a tap of one finger puts the light there', async ({ browser, watch }) => {
	const context = await browser.newContext({ hasTouch: true, viewport: { width: 240, height: 180 } });
	const page = await context.newPage();
	page.on('pageerror', (error) => watch.complaints.push(error.message));
	await drawNothing(page);
	await open(page, '?model=sphere&shells=4&still=1&ui=0&light=0,1,0&camera=0,0,1');
	await page.touchscreen.tap(100, 90);
	await expect.poll(() => light(page)[0]).toBeLessThan(-0.1);
	await context.close();
});
