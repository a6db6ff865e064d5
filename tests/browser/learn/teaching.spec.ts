/** Learn's figures to try first: the opening, a parabola by hand, questions and their answers, means over neighbours. */

import type { Page } from '@playwright/test';
import { expect, open, test } from '../harness.ts';
import { changes, figure, show } from './figures.ts';

test.use({ viewport: { width: 1100, height: 760 } });

/** Opens the lesson with these figures alone. */
async function openWith(page: Page, names: string): Promise<void> {
	await page.route(/\/assets\/(en|index)-[\w-]+\.js$/, async (route) => {
		const response = await route.fetch();
		const others = new RegExp(`data-figure="(?!(?:${names})")`, 'g');
		await route.fulfill({ response, body: (await response.text()).replaceAll(others, 'data-left-out="') });
	});
	await open(page, 'learn.html?still=1&lang=en');
	await expect(page.locator('figure[data-left-out]')).not.toHaveCount(0);
}

test('a parabola is fitted by hand', async ({ page }) => {
	await openWith(page, 'hair');
	await show(page, 'hair');
	const own = async () => Number(await figure(page, 'hair').locator('[data-own]').getAttribute('data-own'));
	const before = await own();
	const middle = figure(page, 'hair').locator('.grip').nth(1);
	const { x, y, width, height } = (await middle.boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
	await page.mouse.move(x + width / 2, y + height / 2);
	await page.mouse.down();
	await page.mouse.move(x + width / 2, y + height / 2 - 40, { steps: 4 });
	await page.mouse.up();
	await expect.poll(own).not.toBe(before);
	const dragged = await own();
	await middle.press('ArrowDown');
	await expect.poll(own).not.toBe(dragged);
	await figure(page, 'hair').getByRole('button', { name: 'Show the best parabola' }).click();
	const [, hand = '', best = ''] = /off by (\d+\.\d+).*the best is off by (\d+\.\d+)/.exec(
		(await figure(page, 'hair').textContent()) ?? '',
	) as RegExpExecArray;
	expect(Number(best)).toBeLessThanOrEqual(Number(hand));
});

test('a question tells whether the guess was right, and shows it in the figure', async ({ page }) => {
	await openWith(page, 'dome|bits');
	await show(page, 'dome');
	const lamp = figure(page, 'dome').locator('canvas.dome');
	const lit = await lamp.getAttribute('data-lamp');
	const question = figure(page, 'dome').locator('fieldset.ask');
	await question.getByRole('radio', { name: 'layer 14' }).check();
	await expect(question).toHaveAttribute('data-answer', 'wrong');
	await expect(question.locator('.right')).toHaveText('layer 4, near the roots');
	await expect(lamp).not.toHaveAttribute('data-lamp', lit ?? '');
	await question.getByRole('radio', { name: 'layer 4' }).check();
	await expect(question).toHaveAttribute('data-answer', 'right');
	await show(page, 'bits');
	const bits = figure(page, 'bits').locator('fieldset.ask');
	await bits.getByRole('radio').nth(2).check();
	await expect(bits).toHaveAttribute('data-answer', /right|wrong/);
	await expect(bits.locator('.right')).toHaveCount(1);
});

test('means over neighbours err less, and hardly without what the layer shares', async ({ page }) => {
	await openWith(page, 'mean');
	await show(page, 'mean');
	const wrong = async () => Number(await figure(page, 'mean').locator('[data-wrong]').getAttribute('data-wrong'));
	const alone = await wrong();
	await figure(page, 'mean').getByRole('slider').fill('3');
	await expect.poll(wrong).toBeLessThan(0.55 * alone);
	const means = await wrong();
	await figure(page, 'mean').getByRole('radio').nth(1).check();
	await expect.poll(wrong).toBeLessThan(means);
});

test('the first screen has fur under a lamp, and the rail leads to every step', async ({ page }) => {
	await openWith(page, 'hello');
	const opening = page.locator('figure[data-figure]').first();
	await expect(opening).toHaveAttribute('data-state', 'ready');
	await expect(opening).toBeInViewport();
	const canvas = opening.locator('canvas');
	await changes(
		page,
		'hello',
		'the lamp',
		async () => {
			await canvas.focus();
			for (let i = 0; i < 6; i++) await page.keyboard.press('ArrowLeft');
		},
		0.5,
	);
	const rail = page.locator('#steps');
	const names = await rail.getByRole('link').allTextContents();
	expect(names.length).toBeGreaterThanOrEqual(15);
	await rail.getByRole('link', { name: 'References' }).click();
	await expect(page.locator('#more')).toBeInViewport();
});
