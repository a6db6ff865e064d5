import type { Page } from '@playwright/test';
import { difference, expect, open, picture, settled, test } from '../harness.ts';
import { drawNothing, shrinkPicture } from '../inPage/gpu.ts';

const parameter = (page: Page, name: string) => new URL(page.url()).searchParams.get(name);
const camera = (page: Page) => parameter(page, 'camera')?.split(',').map(Number) ?? [];

test.use({ viewport: { width: 480, height: 360 } });

/** In the middle of the window, with nothing over it. */
const makeSmall = (page: Page) => shrinkPicture(page, 160, 120, [160, 120]);

const query = '?model=torus&still=1&shells=4&light=-.5,.5,.7&camera=20,10,1';

test('a right drag turns the camera, and the light stays', async ({ page }) => {
	await drawNothing(page);
	await makeSmall(page);
	await open(page, query);
	await page.mouse.move(240, 180);
	await page.mouse.down({ button: 'right' });
	await page.mouse.move(220, 180, { steps: 4 });
	await page.mouse.up({ button: 'right' });
	await expect.poll(() => camera(page)[0]).toBeGreaterThan(30);
	expect(camera(page)[2]).toBeCloseTo(1, 2);
	expect(parameter(page, 'light')).toMatch(/^-0\.50/);
});

test('the wheel comes nearer', async ({ page }) => {
	await drawNothing(page);
	await makeSmall(page);
	await open(page, query);
	await page.mouse.move(240, 180);
	await page.mouse.wheel(0, -300);
	await expect.poll(() => camera(page)[2]).toBeLessThan(0.95);
});

test('the camera button lets a drag turn the camera, and back', async ({ page }) => {
	await drawNothing(page);
	await makeSmall(page);
	await open(page, query);
	const button = page.getByRole('button', { name: 'Turn camera' });
	await expect(button).toHaveAttribute('aria-pressed', 'false');
	await button.focus();
	await page.keyboard.press('Enter');
	await expect(button).toHaveAttribute('aria-pressed', 'true');
	await page.mouse.move(240, 150);
	await page.mouse.down();
	await page.mouse.move(220, 150, { steps: 4 });
	await page.mouse.up();
	const turned = Number((await settled(page, 'camera'))?.split(',')[0]);
	expect(turned).toBeGreaterThan(30);
	await page.keyboard.press('ArrowRight');
	await expect.poll(() => camera(page)[0]).toBeCloseTo(turned + 4, 0);
	await button.click();
	await expect(button).toHaveAttribute('aria-pressed', 'false');
});

test('a link shows the same view again', async ({ page }) => {
	await makeSmall(page);
	await open(page, '?model=torus&still=1&ui=0&shells=4');
	await page.keyboard.press('Shift+ArrowUp');
	await page.mouse.move(240, 180);
	await page.mouse.down({ button: 'right' });
	await page.mouse.move(227, 170, { steps: 4 });
	await page.mouse.up({ button: 'right' });
	expect(await settled(page, 'light')).not.toBeNull();
	expect(camera(page)).toHaveLength(3);
	const shown = () => picture(page.locator('#picture'));
	const before = await shown();
	const link = new URL(page.url()).search;
	await page.goto('about:blank');
	await open(page, link);
	// The backdrop's grain is random, the address has three decimals.
	expect(difference(before, await shown())).toBeLessThan(0.6);
});

test('a target is in the middle, near it, and in the link until another model comes', async ({ page }) => {
	await drawNothing(page);
	await makeSmall(page);
	const box = async () => (await page.locator('#picture').getAttribute('data-box'))?.split(',').map(Number) ?? [];
	await open(page, '?model=torus&still=1&shells=4&camera=0,0,1&target=1,-1,0');
	// The lower right corner of the box, in the middle of 160 × 120 pixels.
	const [left = 0, top = 0, width = 0, height = 0] = await box();
	expect([left + width, top + height]).toEqual([expect.closeTo(80, -1), expect.closeTo(60, -1)]);
	await page.setViewportSize({ width: 900, height: 600 });
	await open(page, '?model=torus&still=1&shells=4&camera=0,0,0.1&target=1,-1,0');
	expect((await box())[2]).toBeGreaterThan(5 * width);
	await page.keyboard.press('Shift+ArrowUp');
	await settled(page, 'light');
	expect(camera(page)[2]).toBeCloseTo(0.1, 2);
	expect(parameter(page, 'target')).toBe('1,-1,0');
	await page.getByRole('combobox', { name: 'Model' }).selectOption('Sphere');
	await expect.poll(() => parameter(page, 'target')).toBeNull();
});

for (const [width, height] of [
	[180, 320],
	[400, 150],
] as const) {
	test(`the model fits a window of ${width} × ${height}`, async ({ page }) => {
		await page.setViewportSize({ width, height });
		// What changes with the light is the model.
		await open(page, '?model=sphere&still=1&ui=0&shells=4&light=0,.2,1');
		const front = await picture(page);
		await open(page, '?model=sphere&still=1&ui=0&shells=4&light=0,.2,-1');
		const back = await picture(page);
		const isModel = (x: number, y: number) => {
			const at = Math.round(y) * width + Math.round(x);
			return Math.abs((front.brightness[at] ?? 0) - (back.brightness[at] ?? 0)) > 12;
		};
		const reach = Math.min(width, height) / 2;
		expect(isModel(width / 2, height / 2)).toBe(true);
		let edge = 0;
		for (let r = 0; r < reach; r++) if (isModel(width / 2, height / 2 - r)) edge = r;
		expect(edge).toBeGreaterThan(reach * 0.6);
		expect(edge).toBeLessThan(reach * 0.99);
	});
}
