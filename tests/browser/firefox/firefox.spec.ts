/** The pages in Firefox: ready without an error; a drag, a split and a drop do what they do elsewhere. */

import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from '@playwright/test';
import { decode } from 'fast-png';
import type { Page } from 'puppeteer-core';
import { type Firefox, launchFirefox, missing } from './launch.ts';

const site = process.env.FURBAKE_URL ?? '';
const TORUS = '?model=torus-512&shells=4&still=1&ui=0&lang=en&camera=0,10,1';

test.describe.configure({ mode: 'serial' });
test.skip(missing() !== undefined, missing());

let firefox: Firefox;
let page: Page;
let complaints: string[] = [];

test.beforeAll(async () => {
	firefox = await launchFirefox();
});

test.afterAll(async () => {
	await firefox?.close();
});

test.beforeEach(async () => {
	complaints = [];
	page = await firefox.browser.newPage();
	page.on('console', (message) => {
		if (message.type() === 'error') complaints.push(message.text());
	});
	page.on('pageerror', (error) => complaints.push(`uncaught: ${(error as Error).message}`));
});

test.afterEach(async () => {
	await page.close();
	expect(complaints).toEqual([]);
});

/** Opens a page that says by its state when it is ready. */
async function open(query: string): Promise<void> {
	await page.goto(site + query);
	await page.waitForFunction(() => document.documentElement.dataset.state !== 'loading', { timeout: 120_000 });
	expect(await state()).toBe('ready');
}

const state = () => page.evaluate(() => document.documentElement.dataset.state);

/** Mean brightness of the left and the right half, 0..255. */
async function halves(): Promise<[left: number, right: number]> {
	const { width, height, channels, data } = decode(await page.screenshot());
	const sums: [number, number] = [0, 0];
	for (let pixel = 0; pixel < width * height; pixel++) {
		const side = pixel % width < width / 2 ? 0 : 1;
		for (let c = 0; c < 3; c++) sums[side] += (data[pixel * channels + c] ?? 0) / (1.5 * width * height);
	}
	return sums;
}

for (const name of ['bench.html', '404.html', 'docs/options.html', 'example.html'])
	test(`${name} comes without an error`, async () => {
		const response = await page.goto(site + name, { waitUntil: 'load' });
		expect(response?.ok()).toBe(true);
		expect(await page.title()).not.toBe('');
	});

test('every figure of Learn is drawn, and a parabola is fitted by hand', async () => {
	await open('learn.html?still=1&lang=en');
	const figures = await page.$$('figure[data-figure]');
	expect(figures.length).toBeGreaterThan(15);
	for (const figure of figures) {
		await figure.evaluate((element) => element.scrollIntoView({ behavior: 'instant' }));
		const drawn = () => figure.evaluate((element) => (element as HTMLElement).dataset.state);
		await expect.poll(drawn).toMatch(/ready|failed/);
		expect(await drawn(), await figure.evaluate((element) => (element as HTMLElement).dataset.figure)).toBe('ready');
	}
	const own = () => page.$eval('[data-own]', (readout) => Number(readout.getAttribute('data-own')));
	const before = await own();
	const [, handle] = await page.$$('figure[data-figure="hair"] .grip');
	await handle?.evaluate((element) => element.scrollIntoView({ behavior: 'instant', block: 'center' }));
	const box = await handle?.boundingBox();
	if (!box) throw new Error('no handle to drag');
	const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
	await page.mouse.move(x, y);
	await page.mouse.down();
	await page.mouse.move(x, y - 40, { steps: 4 });
	await page.mouse.up();
	await expect.poll(own).not.toBe(before);
});

test('a drag takes the light to the other side', async () => {
	await open(`${TORUS}&light=-1,.2,.3`);
	const [left, right] = await halves();
	expect(left).toBeGreaterThan(right + 3);
	await page.mouse.move(100, 150);
	await page.mouse.down();
	await page.mouse.move(200, 150, { steps: 4 });
	await page.mouse.move(330, 150, { steps: 4 });
	await page.mouse.up();
	await expect.poll(async () => (([a, b]) => b - a)(await halves())).toBeGreaterThan(3);
});

test('the tag is lit by drags, and each view has its own light', async () => {
	await page.setViewport({ width: 120, height: 90 });
	await page.goto(`${site}404.html`);
	await page.evaluate(async () => {
		const sheet = new CSSStyleSheet();
		sheet.replaceSync('fur-view { width: 120px; height: 90px }');
		document.adoptedStyleSheets = [sheet];
		const view = '<fur-view src="models/torus-512" camera="20,38,0.9" light="-1,0.2,0.3"></fur-view>';
		document.body.replaceChildren();
		document.body.insertAdjacentHTML('beforeend', view + view);
		await import(`${document.baseURI.replace(/[^/]*$/, '')}fur-view.js`);
	});
	const ready = () => (document.querySelector('fur-view') as { state?: string } | null)?.state === 'ready';
	await page.waitForFunction(ready, { timeout: 120_000 });
	await expect.poll(async () => (([left, right]) => left - right)(await halves())).toBeGreaterThan(3);
	await page.mouse.move(60, 45);
	await page.mouse.down();
	await page.mouse.move(112, 50, { steps: 3 });
	await page.mouse.up();
	await expect.poll(async () => (([left, right]) => right - left)(await halves())).toBeGreaterThan(3);
	const lights = await page.$$eval('fur-view', (views) => views.map((view) => view.getAttribute('light')));
	expect(Number(lights[0]?.split(',')[0])).toBeGreaterThan(0.5);
	expect(lights[1]).toBe('-1,0.2,0.3');
});

test('the panel has a thin scroll bar, and takes no focus from the picture', async () => {
	await open('?model=torus-512&shells=4&still=1&lang=en');
	const scroller = await page.$eval('#panel .lil-root > .lil-children', (element) => {
		const { tabIndex } = element as HTMLElement;
		(element as HTMLElement).focus(); // as a click between its controls does
		return { bar: getComputedStyle(element).scrollbarWidth, tabIndex, active: document.activeElement?.tagName };
	});
	expect(scroller).toEqual({ bar: 'thin', tabIndex: -1, active: 'BODY' });
});

test('two methods stand side by side', async () => {
	await open(`${TORUS}&light=-1,.2,.3`);
	const alone = await halves();
	await open(`${TORUS}&light=-1,.2,.3&split=unlit,0.5`);
	const [left, right] = await halves();
	expect(Math.abs(left - alone[0])).toBeLessThan(1);
	expect(Math.abs(right - alone[1])).toBeGreaterThan(2);
});

test('a dropped bake is shown', async () => {
	await open(`${TORUS}&light=-1,.2,.3`);
	const [left] = await halves();
	const folder = fileURLToPath(new URL('../../../public/models/sphere/', import.meta.url));
	const files = readdirSync(folder).map((name) => [name, readFileSync(`${folder}${name}`).toString('base64')] as const);
	await page.evaluate((files) => {
		const transfer = new DataTransfer();
		for (const [name, base64] of files)
			transfer.items.add(new File([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))], name));
		const event = new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: transfer });
		document.getElementById('picture')?.dispatchEvent(event);
	}, files);
	await expect.poll(async () => Math.abs((await halves())[0] - left)).toBeGreaterThan(2);
	await expect.poll(state).toBe('ready');
});
