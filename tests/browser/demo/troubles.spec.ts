/** What the page says of addresses and models that it cannot show, and what is left to use then. */

import type { Page } from '@playwright/test';
import { expect, halves, open, picture, settled, site, state, test } from '../harness.ts';
import { drawNothing, shrinkPicture } from '../inPage/gpu.ts';

test.use({ viewport: { width: 480, height: 360 } });

/** Small, in the middle of windows that are large enough for what is around it. */
test.beforeEach(({ page }) => shrinkPicture(page, 160, 120, [240, 120]));

/** Holds back files until the answer is called. */
async function held(page: Page, files: string): Promise<() => void> {
	let release = () => {};
	const released = new Promise<void>((resolve) => {
		release = resolve;
	});
	await page.route(files, async (route) => {
		await released;
		await route.continue();
	});
	return release;
}

test('where half of WebGL2 is hidden there are words and a picture, on the page and in the lesson', async ({
	page,
}) => {
	// As Firefox does that resists fingerprinting; it refuses shaders that take more.
	await page.addInitScript(() => {
		const { getParameter, MAX_VARYING_VECTORS } = WebGL2RenderingContext.prototype;
		WebGL2RenderingContext.prototype.getParameter = function (name) {
			return name === MAX_VARYING_VECTORS ? 8 : getParameter.call(this, name);
		};
	});
	await open(page, '?lang=en');
	expect(await state(page)).toBe('failed');
	await expect(page.locator('#fallback')).toContainText('half hidden against fingerprinting');
	await open(page, 'learn.html?lang=en');
	expect(await state(page)).toBe('failed');
	await expect(page.locator('figure[data-figure]').first()).toContainText('needs WebGL2');
});

test('unknown and broken parameters are ignored with a notice', async ({ page }) => {
	await drawNothing(page);
	await open(page, '?model=cat&still=1&light=north&camera=1,2&shells=many&env=mars&colour=red');
	expect(await state(page)).toBe('ready');
	const notices = page.getByRole('status');
	for (const name of ['model=cat', 'light=north', 'camera=1,2', 'shells=many', 'env=mars', 'colour']) {
		await expect(notices).toContainText(name);
	}
	await expect(notices).toContainText('0.001 to 10, such as -20,10,0.9; ignored');
	await page.getByRole('button', { name: 'Close this message' }).first().click();
	await page.keyboard.press('ArrowUp');
	expect(await settled(page, 'model')).toBe(null);
	expect(await settled(page, 'light')).toMatch(/\d/);
});

test('a notice waits for the model before its time runs, and leaves the figures in view', async ({ page }) => {
	await drawNothing(page);
	await page.setViewportSize({ width: 700, height: 640 });
	const release = await held(page, '**/models/sphere/model.gltf');
	await page.clock.install();
	await page.goto(`${site}?model=sphere&still=1&shells=2&details=1&light=north`);
	const notice = page.locator('.notice');
	await expect(notice).toContainText('light=north');
	await page.clock.fastForward(60_000);
	await expect(notice).toBeVisible();
	release();
	await expect.poll(() => state(page)).toBe('ready');
	const [said, figures] = [await notice.boundingBox(), await page.locator('#overlay').boundingBox()];
	expect((said?.y ?? 0) + (said?.height ?? 0)).toBeLessThan(figures?.y ?? 0);
	await page.clock.fastForward(20_000);
	await expect(notice).toHaveCount(0);
});

test('a missing model gets clear words, and the page stays usable', async ({ page, watch }) => {
	await drawNothing(page);
	await page.setViewportSize({ width: 900, height: 600 });
	await open(page, '?model=models/none/&still=1');
	expect(await state(page)).toBe('failed');
	await expect(page.getByRole('status')).toContainText(
		'models/none/ cannot be shown: model.gltf: there is no such file',
	);
	// The browser's own line about the answer 404 is all that is allowed.
	expect(watch.complaints).toHaveLength(1);
	expect(watch.complaints.pop()).toContain('404');
	const tools = page.locator('#hint, #dock');
	expect(await tools.evaluateAll((all) => all.map((one) => getComputedStyle(one).visibility))).toEqual([
		'hidden',
		'hidden',
	]);
	await page.getByRole('combobox', { name: 'Model' }).selectOption('Torus');
	await expect.poll(() => state(page)).toBe('ready');
	await expect(page.locator('#picture')).toBeVisible();
	await expect(page.locator('#dock')).toBeVisible();
});

test('a file that is no glTF gets clear words', async ({ page }) => {
	await drawNothing(page);
	await page.route('**/models/torus/model.gltf', (route) => route.fulfill({ body: 'solid cat' }));
	await open(page, '?model=torus&still=1');
	expect(await state(page)).toBe('failed');
	await expect(page.getByRole('status')).toContainText('torus cannot be shown: model.gltf: expected glTF');
});

test('a broken model from the menu leaves the one before', async ({ page }) => {
	await page.setViewportSize({ width: 900, height: 600 });
	await page.route('**/models/torus/model.gltf', (route) => route.fulfill({ body: '{"asset": {"version": "2.0"}}' }));
	await open(page, '?model=sphere&shells=4&still=1&light=1,0,.3');
	const before = halves(await picture(page.locator('#picture')));
	await page.getByRole('combobox', { name: 'Model' }).selectOption('Torus');
	await expect(page.getByRole('status')).toContainText('torus cannot be shown');
	await expect.poll(() => state(page)).toBe('ready');
	await expect(page.getByRole('combobox', { name: 'Model' })).toHaveValue('Sphere');
	expect(halves(await picture(page.locator('#picture')))[0]).toBeGreaterThan(before[0] * 0.8);
});

test('a broken plane of a furry model gets clear words', async ({ page }) => {
	await drawNothing(page);
	await page.route('**/models/torus/*.png', (route) =>
		route.fulfill({ body: 'not a picture', contentType: 'image/png' }),
	);
	await open(page, '?model=torus&still=1');
	expect(await state(page)).toBe('failed');
	await expect(page.getByRole('status')).toContainText('torus cannot be shown');
});

test('a first model still grows its fur where the next one fails', async ({ page }) => {
	await drawNothing(page);
	await page.setViewportSize({ width: 900, height: 600 });
	const release = await held(page, '**/models/sphere/*.png');
	await page.route('**/models/torus/model.gltf', (route) => route.fulfill({ body: 'solid cat' }));
	await page.goto(`${site}?model=sphere&shells=4&still=1`);
	await page.waitForFunction(() => performance.getEntriesByName('furbake:skin').length > 0);
	await page.getByRole('combobox', { name: 'Model' }).selectOption('Torus');
	await expect(page.getByRole('status')).toContainText('torus cannot be shown');
	release();
	await expect.poll(() => state(page)).toBe('ready');
	await expect(page.getByRole('combobox', { name: 'Model' })).toHaveValue('Sphere');
	await expect(page.getByRole('combobox', { name: 'Preset' })).toBeEnabled({ timeout: 2000 });
	await expect(page.getByRole('status')).toContainText('torus cannot be shown');
});

test('a script that is missing, as after an update of the site, is told, with a way on', async ({ page, watch }) => {
	await drawNothing(page);
	await page.route('**/assets/FurFins-*.js', (route) => route.fulfill({ status: 404 }));
	await page.goto(`${site}?model=sphere&still=1&shells=2`);
	await expect(page.getByRole('status')).toContainText('A file of this page cannot be loaded.');
	await expect.poll(() => state(page)).toBe('failed');
	await page.unrouteAll();
	await page.getByRole('link', { name: 'Reload' }).click();
	await expect.poll(() => state(page)).toBe('ready');
	await expect(page.getByRole('status')).toHaveText('');
	watch.complaints.length = 0;
});

test('a script that is missing when it is first used is told, and the page goes on without', async ({
	page,
	watch,
}) => {
	await drawNothing(page);
	await page.route('**/assets/crowd-*.js', (route) => route.fulfill({ status: 404 }));
	await open(page, '?model=sphere&still=1&shells=2&crowd=4');
	expect(await state(page)).toBe('ready');
	await expect(page.getByRole('status')).toContainText('A file of this page cannot be loaded.');
	await page.unrouteAll();
	watch.complaints.length = 0;
});

test('without the list of models the page says so once', async ({ page, watch }) => {
	await page.route('**/models/models.json', (route) => route.fulfill({ body: '<!doctype html>' }));
	await page.goto(`${site}?still=1`);
	await expect(page.locator('.notice')).toHaveText(/models.json: got no JSON, expected the list of models/);
	await expect.poll(() => state(page)).toBe('failed');
	watch.complaints.length = 0;
});
