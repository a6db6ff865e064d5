import type { Page } from '@playwright/test';
import { difference, expect, open, picture, settled, site, state, test } from '../harness.ts';
import { drawNothing, shrinkPicture } from '../inPage/gpu.ts';

test.use({ viewport: { width: 480, height: 360 } });

/** Small, in the middle of windows that are large enough for what is around it. */
test.beforeEach(({ page }) => shrinkPicture(page, 160, 120, [240, 120]));
const shown = (page: Page) => picture(page.locator('#picture'));

test('the page opens with the first model of the menu, ready and with its controls', async ({ page, watch }) => {
	await page.setViewportSize({ width: 900, height: 600 });
	await shrinkPicture(page, 200, 150);
	await open(page, '');
	expect(await state(page)).toBe('ready');
	expect(watch.requests).toContain(`${site}models/bunny/model.gltf`);
	await expect(page).toHaveTitle(/furbake/);
	await expect(page.locator('html')).toHaveAttribute('lang', 'en');
	await expect(page.getByRole('button', { name: 'Turn camera' })).toBeVisible();
	await expect(page.locator('#overlay')).toContainText(/\d+ draw calls · [\d,]+ triangles/);
});

test('one line of figures, and all of them on demand, as the address says', async ({ page }) => {
	await drawNothing(page);
	await open(page, '?model=sphere&shells=4&still=1');
	const overlay = page.locator('#overlay');
	await expect(overlay.locator('p')).toHaveText(/^at rest · 4 shells$/);
	await expect(overlay.locator('canvas').first()).toBeHidden();
	const line = (await overlay.boundingBox()) ?? { height: 0 };
	expect(line.height).toBeLessThan(30);
	await page.getByRole('button', { name: 'All figures' }).click();
	await expect(overlay.locator('canvas').first()).toBeVisible();
	await expect(overlay).toContainText('textures');
	await expect.poll(() => new URL(page.url()).searchParams.get('details')).toBe('1');
	await open(page, new URL(page.url()).search);
	const fewer = page.getByRole('button', { name: 'Fewer figures' });
	await expect(fewer).toHaveAttribute('aria-expanded', 'true');
	await fewer.press('Enter');
	await expect(overlay.locator('canvas').first()).toBeHidden();
	await expect.poll(() => new URL(page.url()).searchParams.get('details')).toBe(null);
});

test('figures stand above their graphs, and none is wider than its graph', async ({ page }) => {
	await drawNothing(page);
	await open(page, '?model=sphere&shells=4&details=1');
	const captions = page.locator('#overlay figcaption');
	await expect(captions.nth(1)).toHaveText(/^CPU \d+\.\d ms$/);
	const room = await captions.evaluateAll((all: HTMLElement[]) => {
		// A frame of ten seconds, the widest that is shown.
		for (const one of all.slice(1)) one.textContent = 'CPU 10000.0 ms';
		return all.map((one) => (one.parentElement?.clientWidth ?? 0) - one.offsetLeft - one.clientWidth);
	});
	expect(Math.min(...room)).toBeGreaterThan(0);
});

test('every control is reached by the Tab key, and says what it is', async ({ page }) => {
	await drawNothing(page);
	await page.setViewportSize({ width: 900, height: 760 });
	await shrinkPicture(page, 90, 60);
	await open(page, '?model=torus-512&still=1&shells=4&split=unlit,0.5');
	const reached = new Set<string>();
	for (let i = 0; i < 45; i++) {
		await page.keyboard.press('Tab');
		const name = await page.evaluate(() => {
			const at = document.activeElement as (HTMLElement & { labels?: NodeListOf<HTMLElement> | null }) | null;
			const label = document.getElementById(at?.getAttribute('aria-labelledby') ?? '') ?? at?.labels?.[0];
			return at === document.body ? '' : at?.ariaLabel || label?.textContent || at?.textContent || 'no name';
		});
		if (name === '' && i > 10) break;
		reached.add(name.trim());
	}
	expect(reached).not.toContain('no name');
	const header = ['furbake', 'Demo', 'Learn', 'Bench', 'Embed', '中文'];
	const panel = ['Fur', 'Body', 'Model', 'Preset', 'Crowd', 'Light', 'Method', 'Split with', 'Lights', 'Environment'];
	const hair = ['Hair', 'Auto shells', 'Shells', 'Fins', 'Length', 'Density', 'Root', 'Tip', 'Colours as baked'];
	const buttons = ['Copy link', 'Save picture', 'Reset', 'Turn camera', 'Line between PTM and Unlit'];
	for (const name of [...header, ...panel, ...hair, ...buttons]) expect([...reached], name).toContain(name);
	await expect(page.getByRole('application', { name: /, under a lamp that you move/ })).toBeVisible();
});

test('ui=0 leaves the picture alone', async ({ page }) => {
	await drawNothing(page);
	await open(page, '?model=sphere&shells=4&still=1&ui=0');
	for (const element of await page.locator('.ui').all()) await expect(element).toBeHidden();
	await expect(page.locator('#picture')).toBeVisible();
	await expect(page.locator('#overlay')).toBeEmpty();
});

test('fins=0 leaves out the fins, which are one draw call', async ({ page }) => {
	await drawNothing(page);
	const drawn = async (query: string) => {
		await open(page, `?model=sphere&shells=4&still=1${query}`);
		// The figures of the last frame: those before it may have been without fins, too.
		await expect(page.locator('#overlay')).toContainText(/at rest.*draw calls/);
		return Number(/(\d+) draw calls/.exec((await page.locator('#overlay').textContent()) ?? '')?.[1]);
	};
	const without = await drawn('&fins=0');
	expect(await drawn('')).toBe(without + 1);
	expect(await drawn('&fins=1')).toBe(without + 1);
});

test('the lamp is visible, and hidden with ui=0', async ({ page }) => {
	const at = '?model=sphere&shells=4&still=1&light=-1,0,.01&camera=0,0,1';
	const leftmost = async () => {
		const { width, height, brightness } = await shown(page);
		return brightness.filter((_, i) => {
			const [x, y] = [i % width, Math.floor(i / width)];
			return x < width * 0.17 && y > height * 0.45 && y < height * 0.55;
		});
	};
	await open(page, at);
	const lamp = await leftmost();
	expect(Math.max(...lamp)).toBeGreaterThan(220);
	await open(page, `${at}&ui=0`);
	const without = await leftmost();
	expect(Math.max(...lamp.map((value, i) => value - (without[i] ?? 0)))).toBeGreaterThan(100);
});

test('shells are set by the address and by the panel', async ({ page }) => {
	await drawNothing(page);
	await page.setViewportSize({ width: 900, height: 600 });
	await open(page, '?model=torus&still=1&shells=7');
	const field = page.getByLabel('Shells', { exact: true });
	await expect(field).toHaveValue('7');
	const automatic = page.getByRole('checkbox', { name: 'Auto shells' });
	await expect(automatic).not.toBeChecked();
	await field.fill('12');
	await field.press('Enter');
	await expect.poll(() => new URL(page.url()).searchParams.get('shells')).toBe('12');
	expect(await state(page)).toBe('ready');
	await automatic.check();
	await expect(field).toBeDisabled();
	await expect.poll(() => new URL(page.url()).searchParams.get('shells')).toBe(null);
	await expect(page.locator('#overlay')).toContainText(/[1-9]\d shells/);
});

test('the menu changes the model, in the picture and in the address', async ({ page, watch }) => {
	await drawNothing(page);
	await page.setViewportSize({ width: 900, height: 600 });
	await open(page, '?model=torus&still=1&light=0,1,.3');
	await page.getByRole('combobox', { name: 'Model' }).selectOption('Sphere');
	await expect.poll(() => watch.requests).toContain(`${site}models/sphere/model.gltf`);
	await expect.poll(() => state(page)).toBe('ready');
	await expect.poll(() => new URL(page.url()).searchParams.get('model')).toBe('sphere');
	expect(new URL(page.url()).searchParams.get('still')).toBe('1');
});

test('a model that the menu does not offer is shown by its name', async ({ page, watch }) => {
	await drawNothing(page);
	await page.setViewportSize({ width: 900, height: 600 });
	await open(page, '?model=torus-512&shells=4&still=1');
	expect(await state(page)).toBe('ready');
	expect(watch.requests).toContain(`${site}models/torus-512/model.gltf`);
	const offered = await page.locator('#panel select option').allTextContents();
	// Beside those of the menu what is on show, as long as it is.
	expect(offered.filter((title) => title.startsWith('Torus'))).toEqual(['Torus', 'Torus, 512 triangles']);
});

test('a path to a folder is a model, too', async ({ page, watch }) => {
	await drawNothing(page);
	await open(page, '?model=models/torus&still=1');
	expect(await state(page)).toBe('ready');
	expect(watch.requests).toContain(`${site}models/torus/model.gltf`);
});

test('a place is fetched when it is wanted, lights the model and stands behind it; without it all is as before', async ({
	page,
	watch,
}) => {
	await page.setViewportSize({ width: 900, height: 600 });
	const at = '?model=sphere&shells=4&still=1&light=-1,.5,.4';
	const places = () => watch.requests.filter((url) => /\.exr[.-]/.test(url));
	await open(page, at);
	expect(places()).toEqual([]);
	const own = await shown(page);
	const menu = page.getByRole('combobox', { name: 'Environment' });
	await menu.selectOption('Sunset');
	await expect.poll(() => new URL(page.url()).searchParams.get('env')).toBe('sunset');
	await expect.poll(() => state(page)).toBe('ready');
	expect(places()).toHaveLength(1);
	const sunset = await shown(page);
	expect(difference(own, sunset)).toBeGreaterThan(5);
	await menu.selectOption('None');
	await expect.poll(() => new URL(page.url()).searchParams.get('env')).toBe(null);
	await expect.poll(() => state(page)).toBe('ready');
	expect(difference(own, await shown(page))).toBeLessThan(0.5);
	await open(page, `${at}&env=sunset`);
	await expect(menu).toHaveValue('Sunset');
	expect(difference(sunset, await shown(page))).toBeLessThan(0.5);
	const hosts = new Set(watch.requests.filter((url) => !url.startsWith('data:')).map((url) => new URL(url).host));
	expect([...hosts]).toEqual([new URL(site).host]);
});

test('the sun of a place is where the light begins', async ({ page }) => {
	await drawNothing(page);
	await open(page, '?model=sphere&shells=4&still=1&env=sky');
	await page.keyboard.press('ArrowUp');
	const light = ((await settled(page, 'light')) ?? '').split(',').map(Number);
	// 48 degrees above the sea in the picture, to the left as the page's own lamp, and raised by the key.
	expect(light[0]).toBeLessThan(-0.5);
	expect((Math.asin(light[1] ?? 0) * 180) / Math.PI).toBeCloseTo(48 + 4, -1);
});

test('a place that cannot be fetched is told, and the page stays usable', async ({ page, watch }) => {
	await drawNothing(page);
	await page.route('**/city.exr*', (route) => route.abort());
	await open(page, '?model=sphere&shells=4&still=1&env=city');
	expect(await state(page)).toBe('ready');
	await expect(page.getByRole('status')).toContainText('The environment city cannot be shown');
	await page.keyboard.press('ArrowUp');
	expect(await settled(page, 'env')).toBe(null);
	expect(await settled(page, 'light')).not.toBe(null);
	expect(watch.complaints.splice(0).join()).toMatch(/^Failed to load resource[^,]*$/);
});
