/** `<fur-view>` in pages of others: under `default-src 'self'`, ten at a time, moved by hand, taken away. */

import { readFileSync } from 'node:fs';
import { AxeBuilder } from '@axe-core/playwright';
import type { FurView } from '../../../web/view/view.d.ts';
import { CLIPS, rigged } from '../../web/scene/clips/rigged.ts';
import { difference, expect, halves, picture, test } from '../harness.ts';
import { drawNothing, watchGpu } from '../inPage/gpu.ts';
import { type Counts, counts, pixels, type Site, serveView, until, watchDraws, withView } from './host.ts';

let site: Site;

test.use({ viewport: { width: 400, height: 300 } });

test.beforeAll(async () => {
	site = await serveView();
	const model = new URL('../../../public/models/torus-512/', import.meta.url);
	const { extensions: _, ...bald } = JSON.parse(readFileSync(new URL('model.gltf', model), 'utf8'));
	site.write('bald/model.gltf', JSON.stringify(bald));
	site.write('bald/model.bin', readFileSync(new URL('model.bin', model)));
	for (const [name, bytes] of Object.entries(rigged(CLIPS))) site.write(`walker/${name}`, bytes);
});

test.afterAll(() => site?.close());

const TORUS = 'src="models/torus-512/model.gltf" camera="20,38,0.9"';

test('ten on one page show fur, after scrolling too, by one context and under a strict policy', async ({
	page,
	watch,
}) => {
	await watchDraws(page);
	// The first is compressed: its decoder may not be WebAssembly here.
	const views = Array.from({ length: 10 }, (_, i) => {
		const src = i === 0 ? 'src="models/sphere"' : TORUS;
		return `<fur-view id="v${i}" ${src} light="-0.6,0.7,0.4"></fur-view>`;
	});
	const bald = '<fur-view id="bald" src="bald/model.gltf" camera="20,38,0.9" light="-0.6,0.7,0.4"></fur-view>';
	await site.open(page, `${bald}${views.slice(0, 5).join('')}<div class="far"></div>${views.slice(5).join('')}`);
	await until(page, 'ready', '#bald');
	const skin = await pixels(page, '#bald');
	expect(skin.covered).toBeGreaterThan(0.15);
	const furry = async (id: string) => {
		await until(page, 'ready', id);
		const shown = await pixels(page, id);
		expect(shown.covered, id).toBeGreaterThan(0.2);
		expect(shown.contrast, id).toBeGreaterThan(2 * skin.contrast);
	};
	for (const i of [0, 1, 2, 3, 4]) await furry(`#v${i}`);
	// Those below are left alone until they are near.
	expect(await withView(page, ({ state }) => state, '#v9')).toBe('idle');
	const early = site.sent.length;
	await page.locator('#v9').scrollIntoViewIfNeeded();
	for (const i of [5, 6, 7, 8, 9]) await furry(`#v${i}`);
	expect(site.sent.length).toBeGreaterThan(early);
	await page.evaluate(() => scrollTo(0, 0));
	await furry('#v0');
	expect(await counts(page, ({ contexts }) => contexts.length)).toBe(1);

	// What nobody sees is not drawn; at rest nothing is.
	await page.waitForTimeout(300);
	const drawn = await counts(page, ({ draws }) => draws);
	await withView(page, (view) => view.setAttribute('light', '0.8,0.3,0.4'), '#v9');
	await page.waitForTimeout(400);
	expect(await counts(page, ({ draws }) => draws)).toBe(drawn);
	const before = await pixels(page, '#v9');
	await page.locator('#v9').scrollIntoViewIfNeeded();
	await expect.poll(() => pixels(page, '#v9')).not.toEqual(before);
	expect(watch.complaints.splice(0)).toEqual([
		'fur-view: fur: got a model without any, expected a baked one (src="bald/model.gltf")',
	]);
});

test('what is removed frees all it had, the last one the context, and it can come back', async ({ page }) => {
	await watchGpu(page);
	await watchDraws(page);
	await drawNothing(page);
	await site.open(page, `<fur-view id="stays" ${TORUS}></fur-view><div id="place"></div>`);
	await until(page, 'ready');
	const live = () => page.evaluate(() => window.gpu.live());
	const round = async () => {
		await page.locator('#place').evaluate((place) => {
			place.innerHTML = '<fur-view id="goes" src="models/torus" preset="fox" environment="sunset" controls></fur-view>';
		});
		await until(page, 'ready', '#goes');
		const most = await live();
		await page.locator('#goes').evaluate((view) => {
			Object.assign(window, { view });
			view.remove();
		});
		return most;
	};
	// What the library keeps for its next use, it keeps once.
	await round();
	const before = await live();
	const most = await round();
	expect(await live()).toEqual(before);
	expect(most.Texture).toBeGreaterThan(before.Texture ?? 0);
	expect(most.Buffer).toBeGreaterThan(before.Buffer ?? 0);

	// Moved within the page, it goes on as it is.
	await page.evaluate(() => document.querySelector('#place')?.append(document.querySelector('#stays') as Element));
	expect(await withView(page, ({ state }) => state, '#stays')).toBe('ready');
	await page.locator('#stays').evaluate((view) => view.remove());
	await expect.poll(() => counts(page, ({ contexts }) => contexts.map((gl) => gl.isContextLost()))).toEqual([true]);
	await page.evaluate(() => document.querySelector('#place')?.append((window as unknown as { view: Element }).view));
	await until(page, 'ready', '#goes');
	expect(await counts(page, ({ contexts }) => contexts.map((gl) => gl.isContextLost()))).toEqual([true, false]);
});

test('a lost context comes back to the same picture', async ({ page }) => {
	await watchDraws(page);
	await site.open(page, `<fur-view ${TORUS} preset="fox" environment="forest"></fur-view>`);
	await until(page, 'ready');
	await page.waitForTimeout(500);
	const shot = () => picture(page.locator('fur-view'));
	const before = await shot();
	await page.evaluate(async () => {
		const [gl] = (window as unknown as { counts: Counts }).counts.contexts;
		const lose = gl?.getExtension('WEBGL_lose_context');
		const heard = (name: string) =>
			new Promise((resolve) => gl?.canvas.addEventListener(name, resolve, { once: true }));
		const lost = heard('webglcontextlost');
		lose?.loseContext();
		await lost;
		await new Promise((resolve) => setTimeout(resolve, 50));
		const back = heard('webglcontextrestored');
		lose?.restoreContext();
		await back;
	});
	await withView(page, (view) => view.setAttribute('light', '0.9,0.3,0.2'));
	await expect.poll(async () => difference(before, await shot())).toBeGreaterThan(2);
	await withView(page, (view) => view.removeAttribute('light'));
	await expect.poll(async () => difference(before, await shot())).toBeLessThan(0.5);
});

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

test('what cannot be had is told in words and by an event; a later address cancels the earlier', async ({
	page,
	watch,
}) => {
	await drawNothing(page);
	await page.addInitScript(() => {
		const heard: string[] = [];
		Object.assign(window, { heard });
		for (const name of ['ready', 'error'])
			addEventListener(
				name,
				(event) => {
					if ((event.target as Element).localName === 'fur-view')
						heard.push(name === 'ready' ? name : (event as ErrorEvent).message);
				},
				true,
			);
	});
	const heard = () => page.evaluate(() => (window as unknown as { heard: string[] }).heard.splice(0));
	await site.open(page, '<fur-view src="models/none" lang="zh"><p slot="poster">soon</p></fur-view>');
	await until(page, 'failed');
	await expect(page.getByText('无法显示这幅画面。')).toBeVisible();
	await expect(page.getByText('model.gltf: there is no such file')).toHaveAttribute('lang', 'en');
	await expect(page.getByText('soon')).toBeVisible();
	expect(await heard()).toEqual(['fur-view: model.gltf: there is no such file']);
	const complaints = watch.complaints.splice(0).join();
	expect(complaints).toContain('404');
	expect(complaints).toContain('fur-view: model.gltf: there is no such file (src="models/none")');

	await page.route('**/slow/**', () => {});
	await withView(page, (view) => {
		view.src = 'slow/model.gltf';
	});
	await until(page, 'loading');
	await expect(page.getByText('soon')).toBeVisible();
	const cancelled = page.waitForEvent('requestfailed', (request) => request.url().includes('/slow/'));
	await withView(page, (view) => {
		view.src = 'models/torus-512';
	});
	await cancelled;
	await until(page, 'ready');
	await expect(page.getByText('soon')).toBeHidden();
	expect(await heard()).toEqual(['ready']);

	await withView(page, (view) => {
		Object.assign(view, { preset: 'mouse', environment: 'moon', clip: 'Go', light: 'left', camera: '1,2' });
	});
	// The picture stays meanwhile.
	await expect(page.getByText('soon')).toBeHidden();
	const said: string[] = [];
	await expect.poll(async () => said.push(...(await heard())) && said.at(-1)).toBe('ready');
	expect(said).toEqual(
		expect.arrayContaining([
			'fur-view: environment: got moon, expected one of studio, city, sky, sunset, forest',
			'fur-view: clip: got Go, and a model without clips',
			'fur-view: preset: got mouse, expected one of paper, bunny, fox, wolf, sheep, teddy, mole',
			'fur-view: light: got left, expected x,y,z',
			'fur-view: camera: got 1,2, expected azimuth,elevation,distance',
		]),
	);
	for (const message of said.filter((message) => message !== 'ready'))
		expect(watch.complaints).toContain(`${message} (src="models/torus-512")`);

	// A page that takes it upon itself has a quiet console.
	watch.complaints.splice(0);
	await withView(page, (view) => {
		view.addEventListener('error', (event) => event.preventDefault());
		view.setAttribute('light', 'right');
	});
	expect(await heard()).toEqual(['fur-view: light: got right, expected x,y,z']);
});

test('a clip plays until it is paused, and is held where less motion is asked for', async ({ page, watch }) => {
	await drawNothing(page);
	await page.emulateMedia({ reducedMotion: 'reduce' });
	await watchDraws(page);
	await site.open(page, '<fur-view src="walker/model.gltf" clip="Walk" controls></fur-view>');
	await until(page, 'ready');
	expect(await withView(page, ({ clips }) => clips)).toEqual(['Walk', 'Leap', 'Go']);
	const frames = async () => {
		const before = await counts(page, ({ draws }) => draws);
		await page.waitForTimeout(300);
		return (await counts(page, ({ draws }) => draws)) - before;
	};
	expect(await frames()).toBe(0);
	// The page can tell, and play it by a button of its own.
	const paused = () => withView(page, ({ paused }) => paused);
	expect(await paused()).toBe(true);
	await withView(page, (view) => Object.assign(view, { paused: false }).state);
	expect(await frames()).toBeGreaterThan(0);
	await withView(page, (view) => Object.assign(view, { clip: 'Go' }).state);
	expect(await paused()).toBe(true);
	await withView(page, (view) => Object.assign(view, { clip: 'Walk' }).state);
	await page.waitForTimeout(100);
	expect(await frames()).toBe(0);
	await page.getByRole('button', { name: 'Play' }).click();
	expect(await frames()).toBeGreaterThan(0);
	await page.getByRole('button', { name: 'Pause' }).click();
	await page.waitForTimeout(100);
	expect(await frames()).toBe(0);
	await expect(page.locator('fur-view')).toHaveAttribute('paused', '');
	// Its buttons, its words and its poster have nothing that axe minds.
	await page.evaluate(() =>
		document.querySelector('main')?.insertAdjacentHTML('beforeend', '<fur-view src="none"></fur-view>'),
	);
	await page.waitForFunction(() => document.querySelector<FurView>('fur-view[src=none]')?.state === 'failed');
	expect((await new AxeBuilder({ page }).analyze()).violations).toEqual([]);
	expect(watch.complaints.splice(0).join()).toContain('404');
});
