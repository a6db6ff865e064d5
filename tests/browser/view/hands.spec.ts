/** `<fur-view>` in a visitor's hands: drags, keys, fingers, and the button of a clip. */

import { AxeBuilder } from '@axe-core/playwright';
import type { FurView } from '../../../web/view/view.d.ts';
import { CLIPS, rigged } from '../../web/scene/clips/rigged.ts';
import { expect, halves, picture, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';
import { counts, type Site, serveView, TORUS, until, watchDraws, withView } from './host.ts';

let site: Site;

test.use({ viewport: { width: 400, height: 300 } });

test.beforeAll(async () => {
	site = await serveView();
	for (const [name, bytes] of Object.entries(rigged(CLIPS))) site.write(`walker/${name}`, bytes);
});

test.afterAll(() => site?.close());

test('drags and keys move the light, with Shift the camera; attributes and properties say so', async ({
	page,
	watch,
}) => {
	await site.open(page, `<fur-view ${TORUS} light="-0.9,0.3,0.3" alt="A ring"></fur-view>`);
	await until(page, 'ready');
	const view = page.locator('fur-view');
	await page.evaluate(() => {
		const heard: unknown[] = [];
		Object.assign(window, { heard });
		document
			.querySelector('fur-view')
			?.addEventListener('lightchange', (event) => heard.push((event as CustomEvent).detail.light));
	});
	const heard = () => page.evaluate(() => (window as unknown as { heard: number[][] }).heard);
	const shot = async () => halves(await picture(view));
	const [left, right] = await shot();
	expect(left).toBeGreaterThan(right + 3);
	await page.mouse.move(10, 110);
	await page.mouse.down();
	await page.mouse.move(92, 115, { steps: 4 });
	await page.mouse.up();
	await expect.poll(async () => (([l, r]) => r - l)(await shot())).toBeGreaterThan(3);
	const [last] = (await heard()).slice(-1);
	expect(last?.[0]).toBeGreaterThan(0.5);
	const light = await withView(page, (view) => view.light);
	expect(light).toEqual(last);
	const written = ((await view.getAttribute('light')) ?? '').split(',').map(Number);
	for (const [i, value] of written.entries()) expect(value).toBeCloseTo(light[i] ?? 0, 3);

	const place = page.getByRole('application', { name: 'A ring' });
	await place.focus();
	await page.keyboard.press('ArrowLeft');
	const angle = ([x, , z]: number[]) => (Math.atan2(x ?? 0, z ?? 0) * 180) / Math.PI;
	expect(angle(await withView(page, (view) => view.light))).toBeCloseTo(angle(light) - 4, 3);
	expect(await withView(page, ({ camera }) => camera)).toEqual([20, 38, 0.9]);
	await page.keyboard.press('Shift+ArrowRight');
	await page.keyboard.press('Shift+ArrowUp');
	await page.keyboard.press('+');
	await expect(view).toHaveAttribute('camera', '24,42,0.833');
	const before = (await heard()).length;
	await withView(page, (view) => view.reset());
	await expect(view).toHaveAttribute('light', '-0.9,0.3,0.3');
	await expect(view).toHaveAttribute('camera', '20,38,0.9');
	// A visitor has not moved it.
	expect(await heard()).toHaveLength(before);
	const resetButton = () =>
		view
			.locator('button')
			.last()
			.evaluate((button: HTMLElement) => button.click());
	await resetButton();
	expect(await heard()).toHaveLength(before);
	await page.keyboard.press('ArrowLeft');
	await resetButton();
	await expect(view).toHaveAttribute('light', '-0.9,0.3,0.3');
	expect(await heard()).toHaveLength(before + 2);
	const set = await withView(page, (view) => {
		Object.assign(view, { light: [0, 3, 4], camera: [5, 95, 9], controls: true, paused: true, clip: 'Go' });
		return view.outerHTML;
	});
	for (const part of ['light="0,3,4"', 'camera="5,95,9"', 'controls=""', 'paused=""', 'clip="Go"'])
		expect(set).toContain(part);
	const values = await withView(page, ({ light, camera }) => ({ light, camera }));
	expect(values.camera).toEqual([5, 89.9, 4]);
	for (const [i, value] of [0, 0.6, 0.8].entries()) expect(values.light[i]).toBeCloseTo(value, 9);
	expect(watch.complaints.splice(0).join()).toMatch(
		/^fur-view: clip: got Go, and a model without clips \(src="[^"]*"\)$/,
	);
});

test('a finger that goes aside moves the light, one that goes up scrolls the page', async ({ browser }) => {
	const context = await browser.newContext({ hasTouch: true, viewport: { width: 400, height: 300 } });
	const page = await context.newPage();
	await drawNothing(page);
	await site.open(page, `<fur-view ${TORUS} light="0,0.6,0.8"></fur-view><div class="far"></div>`);
	await until(page, 'ready');
	const client = await context.newCDPSession(page);
	const swipe = async (right: number, down: number) => {
		const [x, y] = [40, 120];
		await client.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x, y }] });
		for (const share of [0.2, 0.4, 0.6, 0.8, 1])
			await client.send('Input.dispatchTouchEvent', {
				type: 'touchMove',
				touchPoints: [{ x: x + right * share, y: y + down * share }],
			});
		await client.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
	};
	const light = () => withView(page, (view) => view.getAttribute('light'));
	await swipe(40, 0);
	await expect.poll(light).not.toBe('0,0.6,0.8');
	expect(await page.evaluate(() => scrollY)).toBe(0);
	const before = await light();
	await swipe(0, -60);
	await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(30);
	expect(await light()).toBe(before);
	await context.close();
});

test('a clip plays until it is paused, and is held where less motion is asked for', async ({ page, watch }) => {
	await drawNothing(page);
	await page.emulateMedia({ reducedMotion: 'reduce' });
	await watchDraws(page);
	await site.open(page, '<fur-view src="walker/model.gltf" clip="Walk" controls></fur-view>');
	await until(page, 'ready');
	expect(await withView(page, ({ clips }) => clips)).toEqual(['Walk', 'Leap', 'Go']);
	const draws = () => counts(page, ({ draws }) => draws);
	const frames = async () => {
		const before = await draws();
		await page.waitForTimeout(300);
		return (await draws()) - before;
	};
	const moves = async () => expect.poll(draws).toBeGreaterThan(await draws());
	const rests = () => expect.poll(frames).toBe(0);
	await rests();
	// The page can tell, and play it by a button of its own.
	const paused = () => withView(page, ({ paused }) => paused);
	expect(await paused()).toBe(true);
	await withView(page, (view) => Object.assign(view, { paused: false }).state);
	await moves();
	await withView(page, (view) => Object.assign(view, { clip: 'Go' }).state);
	expect(await paused()).toBe(true);
	await withView(page, (view) => Object.assign(view, { clip: 'Walk' }).state);
	await rests();
	await page.getByRole('button', { name: 'Play' }).click();
	await moves();
	await page.getByRole('button', { name: 'Pause' }).click();
	await rests();
	await expect(page.locator('fur-view')).toHaveAttribute('paused', '');
	// Its buttons, its words and its poster have nothing that axe minds.
	await page.evaluate(() =>
		document.querySelector('main')?.insertAdjacentHTML('beforeend', '<fur-view src="none"></fur-view>'),
	);
	await page.waitForFunction(() => document.querySelector<FurView>('fur-view[src=none]')?.state === 'failed');
	expect((await new AxeBuilder({ page }).analyze()).violations).toEqual([]);
	expect(watch.complaints.splice(0).join()).toContain('404');
});
