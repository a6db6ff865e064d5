/** The page by keyboard and screen reader. */

import type { Page } from '@playwright/test';
import { expect, open, settled, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';

/** Wide enough for an open panel. */
test.use({ viewport: { width: 1000, height: 720 } });

const said = (page: Page) => page.locator('[aria-live=polite].hidden');

test('the picture has the name of its model, and tells where the lamp and the camera go', async ({ page }) => {
	await drawNothing(page);
	await open(page, '?model=sphere&still=1&shells=2&light=0,0,1&camera=0,0,1');
	const picture = page.getByRole('application', { name: /^Sphere, under a lamp/ });
	await expect(picture).toBeVisible();
	await expect(picture).toHaveAccessibleDescription(/Plus and minus come nearer/);
	await expect(page.getByText('Growing fur')).toBeHidden();
	await picture.focus();
	for (const key of ['ArrowRight', 'ArrowRight', 'ArrowUp']) await page.keyboard.press(key);
	await expect(said(page)).toHaveText('Lamp 8° to the right, 4° up');
	await page.getByRole('button', { name: 'Turn camera' }).click();
	await page.keyboard.press('Shift+ArrowLeft');
	await expect(said(page)).toHaveText(/^Camera 12° to the (left|right), 0° up, distance 1.00$/);
	await page.getByRole('combobox', { name: 'Model' }).selectOption('Torus');
	await expect(said(page)).toHaveText('Torus is on show.');
	await expect(page.getByRole('application', { name: /^Torus/ })).toBeVisible();
});

test('signs zoom on the picture alone, and arrow keys leave links to themselves', async ({ page }) => {
	await drawNothing(page);
	await open(page, '?model=sphere&still=1&shells=2&light=0,0,1&camera=0,0,1');
	const before = page.url();
	await page.getByRole('link', { name: 'Learn' }).focus();
	for (const key of ['+', '-', 'ArrowLeft']) await page.keyboard.press(key);
	await page.locator('body').evaluate(() => (document.activeElement as HTMLElement).blur());
	await page.keyboard.press('+');
	await page.waitForTimeout(300);
	expect(page.url()).toBe(before);
	await page.locator('#picture').focus();
	await page.keyboard.press('+');
	await expect.poll(() => settled(page, 'camera')).toMatch(/,0\.9\d*$/);
});

test('a clip that is held holds the lamp, too, and so does a system that asks for less motion', async ({ page }) => {
	await drawNothing(page);
	for (const hold of [
		() => page.getByRole('checkbox', { name: 'Play' }).uncheck(),
		() => page.emulateMedia({ reducedMotion: 'reduce' }),
	]) {
		await open(page, '?shells=2&planes=64');
		await expect(page.locator('#overlay')).toContainText('fps');
		await hold();
		await expect(page.locator('#overlay')).toContainText('at rest', { timeout: 15_000 });
	}
});

test('what is reached by the keyboard is not below the buttons of the panel', async ({ page }) => {
	await drawNothing(page);
	await open(page, '?model=bunny&still=1&shells=2&planes=64');
	await page.getByRole('combobox', { name: 'Model' }).focus();
	const covered: string[] = [];
	for (let i = 0; i < 34; i++) {
		const name = await page.evaluate(() => {
			const { activeElement: field } = document;
			const place = field?.closest('.lil-controller');
			if (!place) return '';
			const { left, top, width, height } = place.getBoundingClientRect();
			const hit = document.elementFromPoint(left + width / 2, top + height / 2);
			return place.contains(hit) ? '' : (place.textContent ?? '?');
		});
		if (name) covered.push(name);
		await page.keyboard.press('Tab');
	}
	expect(covered).toEqual([]);
});

test('a number tells its range; a notice stays while it has the focus', async ({ page }) => {
	await drawNothing(page);
	await page.clock.install();
	await open(page, '?model=sphere&still=1&shells=2&light=north');
	const lights = page.getByRole('spinbutton', { name: 'Lights' });
	await expect(lights).toHaveAttribute('aria-valuemin', '1');
	await expect(lights).toHaveAttribute('aria-valuemax', '8');
	const weather = page.getByRole('group', { name: 'Weather' });
	await expect(weather).toHaveAccessibleDescription(/without gusts/);
	const close = page.getByRole('button', { name: 'Close this message' });
	await close.focus();
	await page.clock.runFor(20_000);
	await expect(close).toBeFocused();
	await page.locator('#picture').focus();
	await page.mouse.move(0, 0);
	await page.clock.runFor(20_000);
	await expect(close).toHaveCount(0);
});
