/** Learn's figures to try first: the opening, a parabola by hand, questions and their answers, means over neighbours. */

import type { Locator } from '@playwright/test';
import { expect, test } from '../harness.ts';
import { changes, figure, openWith, show } from './figures.ts';

test.use({ viewport: { width: 1100, height: 760 } });

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
	const at = async () => Number(await middle.getAttribute('aria-valuenow'));
	const most = Number(await middle.getAttribute('aria-valuemax'));
	for (const [key, value] of [
		['Home', 0],
		['PageUp', 0.1 * most],
		['End', most],
		['PageDown', 0.9 * most],
	] as const) {
		await middle.press(key);
		await expect.poll(at, key).toBeCloseTo(value, 2);
	}
	const lamp = figure(page, 'hair').locator('.sketch');
	for (const [key, angle] of [
		['Home', '-84'],
		['PageUp', '-64'],
		['End', '84'],
	] as const) {
		await lamp.press(key);
		await expect(lamp).toHaveAttribute('aria-valuenow', angle);
	}
	// The ray has the lamp's direction, and the spot is as high as the layer.
	const ray = await lamp.locator('.beam:not(.aside)').evaluate((line) => {
		const [x1 = 0, y1 = 0, x2 = 0, y2 = 0] = ['x1', 'y1', 'x2', 'y2'].map((name) => Number(line.getAttribute(name)));
		return (Math.atan2(x1 - x2, y2 - y1) * 180) / Math.PI;
	});
	expect(ray).toBeCloseTo(84, 0);
	const spot = async () => Number(await lamp.locator('.spot').getAttribute('cy'));
	const middleLayer = await spot();
	await figure(page, 'hair').getByRole('radio', { name: '14', exact: true }).check();
	await expect.poll(spot).toBeLessThan(middleLayer - 10);
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
	// Keys that walk through the answers give none.
	const [, second] = await question.getByRole('button').all();
	await question.getByRole('button').first().focus();
	for (const key of ['ArrowRight', 'ArrowDown', 'Tab']) await page.keyboard.press(key);
	await expect(second as Locator).toBeFocused();
	await expect(question.getByRole('status')).toHaveText('');
	await page.keyboard.press('Enter');
	await expect(question).toHaveAttribute('data-answer', 'wrong');
	await expect(question.getByRole('status')).toContainText('No. Layer 4 loses');
	await expect(question.getByRole('button', { name: 'layer 14', pressed: true })).toBeFocused();
	await expect(question.locator('.right')).toHaveText('layer 4, near the roots');
	await expect(lamp).not.toHaveAttribute('data-lamp', lit ?? '');
	await question.getByRole('button', { name: 'layer 4' }).click();
	await expect(question).toHaveAttribute('data-answer', 'right');
	await show(page, 'bits');
	const bits = figure(page, 'bits').locator('fieldset.ask');
	await bits.getByRole('button').nth(2).click();
	await expect(bits).toHaveAttribute('data-answer', /right|wrong/);
	await expect(bits.locator('.right')).toHaveCount(1);
	// Both values beside the curves can be read, however near the curves are.
	for (const few of ['2', '3', '8']) {
		await figure(page, 'bits').getByRole('slider').fill(few);
		const values = figure(page, 'bits').locator('.plot .value');
		await expect(values).toHaveCount(2);
		const [a, b] = await values.evaluateAll((all) => all.map((each) => each.getBoundingClientRect().toJSON()));
		expect(Math.max(a.top, b.top), few).toBeGreaterThan(Math.min(a.bottom, b.bottom));
	}
});

test('means over neighbours err less, and hardly without what the layer shares', async ({ page }) => {
	await openWith(page, 'mean');
	await show(page, 'mean');
	const wrong = async () => Number(await figure(page, 'mean').locator('[data-wrong]').getAttribute('data-wrong'));
	const alone = await wrong();
	// Its first lamp shows what the layer shares.
	const own = /This lamp: (\d+) % off, (\d+) % without/;
	const [, all, without] = own.exec((await figure(page, 'mean').textContent()) ?? '') as RegExpExecArray;
	expect(Number(without)).toBeLessThan(0.6 * Number(all));
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

test('a step stays where it belongs while figures above it grow, until the visitor scrolls', async ({ page }) => {
	/** Pixels between a step's top and where the style sheet wants it. */
	const off = (id: string) =>
		page.locator(`#${id}`).evaluate((step) => {
			const wanted = Number.parseFloat(getComputedStyle(document.documentElement).scrollPaddingTop);
			return Math.abs(step.getBoundingClientRect().top - wanted);
		});
	const drawn = async (...names: string[]) => {
		for (const name of names) await expect(figure(page, name)).toHaveAttribute('data-state', 'ready');
	};
	await openWith(page, 'slices|hair|bits|nap', '#hair');
	await drawn('slices', 'hair');
	expect(await off('hair')).toBeLessThan(2);

	const link = page.locator('#steps').getByRole('link', { name: 'The rivals' });
	await page.evaluate(() => scrollTo({ top: 0, behavior: 'instant' }));
	await link.click();
	await drawn('nap');
	expect(await off('rivals')).toBeLessThan(2);
	expect(page.url()).toContain('#rivals');

	// By the wheel the visitor leaves; a figure that changes then moves nothing back.
	await page.mouse.move(600, 400);
	await page.mouse.wheel(0, 300);
	await expect.poll(() => off('rivals')).toBeGreaterThan(250);
	await figure(page, 'nap').evaluate((element) => {
		element.style.paddingBottom = '100px';
	});
	await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
	expect(await off('rivals')).toBeGreaterThan(150);
});

test('steps of the list have their numbers', async ({ page }) => {
	await openWith(page, 'hello');
	const links = page.locator('#steps').getByRole('link');
	await expect(links.first()).toHaveAccessibleName('1 Why shells?');
	await expect(links.filter({ hasText: 'The rivals' })).toHaveAccessibleName('11 The rivals');
	await expect(links.last()).toHaveAccessibleName('References');
});
