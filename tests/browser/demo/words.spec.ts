/** The page in two languages, on the narrowest phone. */

import type { Page } from '@playwright/test';
import { expect, site, state, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';

test.use({ viewport: { width: 360, height: 640 }, hasTouch: true, isMobile: true, locale: 'zh-CN' });

interface Box {
	name: string;
	x: number;
	y: number;
	width: number;
	height: number;
}

const ready = (page: Page) => expect.poll(() => state(page)).toBe('ready');

/** Nothing is cut off, and nothing lies over anything else. */
async function expectRoom(page: Page): Promise<void> {
	const boxes: Box[] = [];
	for (const name of ['#top', '#hint', '#panel .lil-root', '#overlay', '#dock']) {
		const box = await page.locator(name).boundingBox();
		expect(box, name).not.toBeNull();
		if (box) boxes.push({ name, ...box });
	}
	for (const [i, a] of boxes.entries()) {
		expect(a.x >= 0 && a.y >= 0 && a.x + a.width <= 360 && a.y + a.height <= 640, `${a.name} in the window`).toBe(true);
		for (const b of boxes.slice(i + 1)) {
			const apart = a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
			expect(apart, `${a.name} beside ${b.name}`).toBe(true);
		}
	}
	const links = page.locator('#top a');
	for (const link of await links.all()) expect((await link.boundingBox())?.height).toBeLessThan(50);
}

test('the page speaks Chinese where that is preferred, and English when asked', async ({ page }) => {
	await drawNothing(page);
	await page.goto(`${site}?model=torus-512&still=1&shells=2&light=north`);
	// At once: notices go by themselves.
	await expect(page.getByRole('status')).toContainText('light=north：应为方向 x,y,z，例如 -0.9,0.45,0.2；已忽略');
	await expect(page.locator('html')).toHaveAttribute('lang', 'zh-Hans');
	await ready(page);
	await expect(page).toHaveTitle(/拖动光源/);
	await expect(page.getByRole('application', { name: /，光源可移动$/ })).toBeVisible();
	await expect(page.locator('#hint')).toContainText('双指');
	await expect(page.locator('#overlay')).toContainText('次绘制调用');
	await expectRoom(page);
	await page.locator('#panel .lil-title').first().tap();
	await expect(page.getByRole('combobox', { name: '模型' })).toBeVisible();
	await page.getByRole('link', { name: 'English' }).tap();
	await page.waitForURL(/lang=en/);
	await expect(page.locator('html')).toHaveAttribute('lang', 'en');
	expect(new URL(page.url()).searchParams.get('model')).toBe('torus-512');
	await expect(page.locator('#hint')).toContainText('two fingers');
	await ready(page);
	await expectRoom(page);
});
