/** Learn by keyboard and by ear: the order of the Tab key, names, what moves by itself, states that can be told apart. */

import type { Page } from '@playwright/test';
import { expect, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';
import { figure, openWith } from './figures.ts';

test.use({ viewport: { width: 1100, height: 500 } });

/** Figure that has the focus, and how its element is called. */
const focused = (page: Page) =>
	page.evaluate(() => {
		const { activeElement: element } = document;
		const place = element?.closest<HTMLElement>('figure')?.dataset.figure;
		return [place, element?.className === 'stand-in' ? 'stand-in' : element?.localName];
	});

test('Tab comes to every figure in its turn, and builds it', async ({ page }) => {
	await drawNothing(page);
	await openWith(page, 'hello|texel|bits|pose|nothing');
	// Not near, and named all the same.
	for (const [name, label] of [
		['texel', 'One texel, six numbers'],
		['bits', 'Bytes are enough'],
		['pose', 'The light follows the pose'],
	] as const) {
		await expect(figure(page, name)).not.toHaveAttribute('data-state');
		await expect(figure(page, name)).toHaveAccessibleName(label);
		await expect(figure(page, name).getByRole('button')).toHaveAccessibleName(`Draw the figure: ${label}`);
	}
	await figure(page, 'hello').getByRole('application').focus();
	await page.keyboard.press('Tab');
	await expect.poll(() => focused(page)).toEqual(['texel', 'canvas']);
	await expect(figure(page, 'texel').getByRole('application').first()).toBeInViewport();
	await expect(figure(page, 'texel').locator('.stand-in')).toHaveCount(0);
	// Those beyond are still to come, the one before is passed backwards.
	await expect(figure(page, 'pose')).not.toHaveAttribute('data-state');
	await page.keyboard.press('Shift+Tab');
	await expect.poll(() => focused(page)).toEqual(['hello', 'canvas']);

	// From behind one comes to a figure's last control; of a choice, to what is chosen.
	await page.locator('#more button').focus();
	for (let i = 0; i < 40 && (await focused(page))[0] !== 'pose'; i++) await page.keyboard.press('Shift+Tab');
	await expect.poll(() => focused(page)).toEqual(['pose', 'input']);
	for (let i = 0; i < 40 && (await focused(page))[0] !== 'bits'; i++) await page.keyboard.press('Shift+Tab');
	await expect.poll(() => focused(page)).toEqual(['bits', 'input']);
	await expect(figure(page, 'bits').locator(':focus')).toBeChecked();
});

test('a figure that fails hands the focus to the words that say why', async ({ page, watch }) => {
	await drawNothing(page);
	await page.route('**/lesson/lesson.json', (route) => route.fulfill({ status: 404 }));
	await openWith(page, 'hello|texel');
	await figure(page, 'hello').getByRole('application').focus();
	await page.keyboard.press('Tab');
	await expect(figure(page, 'texel').locator('.words')).toBeFocused();
	expect(watch.complaints.splice(0).join()).toContain('404');
});

test('pictures that take keys are applications, those that do not are images, and values are spoken', async ({
	page,
}) => {
	await drawNothing(page);
	await openWith(page, 'dome', '#dome');
	const lamps = figure(page, 'dome').getByRole('application');
	await expect(lamps).toHaveAccessibleName(/^Dome of lamps/);
	await expect(figure(page, 'dome').locator('canvas.slice')).toHaveRole('img');
	await lamps.press('ArrowRight');
	await expect(figure(page, 'dome').locator('.hidden[role=status]')).toHaveText(
		/^Lamp \d+ of (64|32 that the fit never sees)/,
	);
	const stops = await page
		.locator('canvas')
		.evaluateAll((all) =>
			all.map((canvas) => [(canvas as HTMLElement).tabIndex, canvas.getAttribute('role')].join()).sort(),
		);
	expect(stops.filter((stop) => stop !== '-1,' && stop !== '-1,null')).toEqual(['-1,img', '0,application']);
});

test('light and wind are held by a button, and by a preference that comes later', async ({ page }) => {
	await drawNothing(page);
	// Pictures of the wind, counted.
	await page.addInitScript(() => {
		const { drawImage } = CanvasRenderingContext2D.prototype;
		const counted = function (this: CanvasRenderingContext2D, ...args: Parameters<typeof drawImage>) {
			const { dataset } = this.canvas.closest<HTMLElement>('figure') ?? {};
			if (dataset?.figure === 'wind') dataset.drawn = String(Number(dataset.drawn ?? 0) + 1);
			return drawImage.apply(this, args);
		};
		Object.assign(CanvasRenderingContext2D.prototype, { drawImage: counted });
	});
	await openWith(page, 'hello|wind|pose', '', 'lang=en');
	const wind = () => figure(page, 'wind').getAttribute('data-drawn');
	const hold = page.getByRole('button', { name: 'Hold light and wind' });
	await expect(hold).toBeVisible();
	await expect(hold).toHaveAttribute('aria-pressed', 'false');
	/** Light moments of a vertex, which follow the lamp. */
	const light = () => figure(page, 'pose').locator('canvas').getAttribute('data-moments');
	const rests = (what: string, read: () => Promise<unknown>) =>
		expect(async () => {
			const before = await read();
			await page.waitForTimeout(400);
			expect(await read(), what).toEqual(before);
		}).toPass({ intervals: [50], timeout: 10_000 });
	const moves = async (read: () => Promise<unknown>) => {
		const before = JSON.stringify(await read());
		await expect.poll(async () => JSON.stringify(await read())).not.toBe(before);
	};
	await figure(page, 'pose').evaluate((element) => element.scrollIntoView());
	await expect(figure(page, 'pose')).toHaveAttribute('data-state', 'ready');
	await moves(light);
	await hold.press('Enter');
	await expect(hold).toHaveAttribute('aria-pressed', 'true');
	await rests('the lamp', light);
	await figure(page, 'wind').evaluate((element) => element.scrollIntoView());
	await expect(figure(page, 'wind')).toHaveAttribute('data-state', 'ready');
	await rests('the wind', wind);
	await hold.press('Enter');
	await figure(page, 'wind').evaluate((element) => element.scrollIntoView());
	await moves(wind);
	await page.emulateMedia({ reducedMotion: 'reduce' });
	await rests('the wind', wind);
	await rests('the lamp', light);
	await expect(hold).toHaveAttribute('aria-pressed', 'true');
});

/** Contrast of a chosen and an unchosen label's grounds, and of the chosen one's text with its own. */
const contrasts = (page: Page) =>
	page.locator('figure[data-figure=dome]').evaluate((figure) => {
		const context = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
		const luminance = (...colours: string[]) => {
			for (const colour of colours) {
				(context as OffscreenCanvasRenderingContext2D).fillStyle = colour;
				context?.fillRect(0, 0, 1, 1);
			}
			const [r = 0, g = 0, b = 0] = [...(context?.getImageData(0, 0, 1, 1).data ?? [])].map((byte) =>
				byte <= 10 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4,
			);
			return 0.2126 * r + 0.7152 * g + 0.0722 * b;
		};
		const contrast = (a: number, b: number) => (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
		const styleOf = (selector: string) => getComputedStyle(figure.querySelector(selector) as Element);
		const ground = getComputedStyle(document.body).backgroundColor;
		const [chosen, other] = [styleOf('input:checked + span'), styleOf('input:not(:checked) + span')];
		const [on, off] = [chosen, other].map(({ backgroundColor }) => luminance(ground, backgroundColor));
		return {
			state: contrast(on as number, off as number),
			text: contrast(on as number, luminance(chosen.color)),
		};
	});

test('what is chosen stands out, in either scheme and in colours of the system', async ({ page }) => {
	await drawNothing(page);
	await openWith(page, 'dome', '#dome');
	await expect(figure(page, 'dome')).toHaveAttribute('data-state', 'ready');
	for (const media of [
		{ colorScheme: 'light' },
		{ colorScheme: 'dark' },
		{ colorScheme: 'dark', forcedColors: 'active' },
	] as const) {
		await page.emulateMedia(media);
		const { state, text } = await contrasts(page);
		expect(state, JSON.stringify(media)).toBeGreaterThan(3);
		expect(text, JSON.stringify(media)).toBeGreaterThan(4.5);
	}
});

test('the button that prints keeps the focus while it waits', async ({ page }) => {
	await drawNothing(page);
	await page.addInitScript(() => {
		Object.assign(window, { printed: 0, print: () => (window as unknown as { printed: number }).printed++ });
	});
	let goOn = () => {};
	const pressed = new Promise<void>((resolve) => {
		goOn = resolve;
	});
	await page.route('**/lesson/lesson.json', async (route) => {
		await pressed;
		await route.continue();
	});
	await openWith(page, 'hello|bits');
	const print = page.getByRole('button', { name: 'Print, with all figures' });
	await print.press('Enter');
	await expect(print).toHaveAttribute('aria-disabled', 'true');
	await expect(print).toBeFocused();
	// Asked a second time it goes on waiting.
	await page.keyboard.press('Enter');
	goOn();
	await expect(figure(page, 'bits')).toHaveAttribute('data-state', 'ready');
	await expect.poll(() => page.evaluate(() => (window as unknown as { printed: number }).printed)).toBe(1);
	await expect(print).toBeFocused();
	await expect(print).not.toHaveAttribute('aria-disabled');
});
