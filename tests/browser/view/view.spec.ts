/** `<fur-view>` in pages of others: under `default-src 'self'`, ten at a time, taken away, and what they say of what cannot be had. */

import { readFileSync } from 'node:fs';
import { difference, expect, picture, test } from '../harness.ts';
import { compileAside, drawNothing, unready, watchGpu } from '../inPage/gpu.ts';
import { type Counts, counts, pixels, type Site, serveView, TORUS, until, watchDraws, withView } from './host.ts';

let site: Site;

test.use({ viewport: { width: 400, height: 300 } });

test.beforeAll(async () => {
	site = await serveView();
	const model = new URL('../../../public/models/torus-512/', import.meta.url);
	const { extensions: _, ...bald } = JSON.parse(readFileSync(new URL('model.gltf', model), 'utf8'));
	site.write('bald/model.gltf', JSON.stringify(bald));
	site.write('bald/model.bin', readFileSync(new URL('model.bin', model)));
});

test.afterAll(() => site?.close());

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

test('it is drawn once its programs are compiled, where that is done aside', async ({ page }) => {
	await compileAside(page);
	await site.open(page, `<fur-view ${TORUS}></fur-view>`);
	await until(page, 'ready');
	expect((await pixels(page, 'fur-view')).covered).toBeGreaterThan(0.2);
	expect(await unready(page, /^(FurMaterial|FurFinMaterial|BodyLight)$/)).toEqual([]);
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
