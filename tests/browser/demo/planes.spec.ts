/** Finer planes after the first fur, and outlines without stair steps. */

import type { Page } from '@playwright/test';
import { expect, open, site, state, test, type Watch } from '../harness.ts';
import { compileAside, drawNothing, shrinkPicture, unready } from '../inPage/gpu.ts';
import { openInPage, served } from '../library.ts';

declare const loaded: typeof import('../inPage/fade.ts');

const fine = ({ requests }: Watch) => requests.filter((url) => url.includes('/models/fine-'));
const mark = (page: Page, name: string) =>
	page.evaluate((called) => performance.getEntriesByName(called)[0]?.startTime, `furbake:${name}`);

test('furs go over into one another step by step, compiled before they are seen', async ({ page }) => {
	await openInPage(page, 'fade');
	const model = (name: string) => served(`public/models/${name}/model.gltf`);
	const { whole, first, last, worst, programs, textures, parts, left, error } = await page.evaluate(
		(urls) => loaded.fade(...urls, 6),
		[model('torus-512'), model('pelt-short')] as [string, string],
	);
	expect(whole.mean, 'from one to the other').toBeGreaterThan(1);
	expect(first.most, 'the first frame').toBeLessThanOrEqual(1);
	expect(last.most, 'the last frame').toBeLessThanOrEqual(1);
	expect(worst / whole.mean, 'the largest step').toBeLessThan(0.3);
	expect(programs, 'compiled while it is seen').toBeLessThanOrEqual(1);
	expect(textures, 'left behind').toBeLessThanOrEqual(2);
	expect(parts).toEqual([true, true]);
	expect(left).toBe(false);
	expect(error).toBe(0);
});

test('outlines are nearer to those of many samples, of what is marked over any pattern', async ({ page }) => {
	await openInPage(page, 'fade');
	for (const marked of [false, true]) {
		const { plain, smooth, opaque } = await page.evaluate((on) => loaded.outline(on), marked);
		expect(smooth / plain, marked ? 'marked' : 'by its shade').toBeLessThan(0.8);
		expect(opaque).toBe(true);
	}
});

test.describe('the page', () => {
	test.use({ viewport: { width: 900, height: 640 } });
	test.beforeEach(async ({ page }) => {
		await drawNothing(page);
		await shrinkPicture(page, 90, 70);
	});

	test('draws skin and fur once their programs are compiled, where that is done aside', async ({ page }) => {
		await compileAside(page);
		await open(page, '?shells=4');
		expect(await state(page)).toBe('ready');
		await expect.poll(() => mark(page, 'fine')).toBeGreaterThan(0);
		const used = await page.evaluate(() => window.unready);
		expect(used, 'programs of the output are not waited for').toContain('BackgroundMaterial');
		expect(await unready(page, /^(FurMaterial|FurFinMaterial|BodyLight|skin|nose|whisker)$/)).toEqual([]);
	});

	test('has finer planes come after the first fur, unasked', async ({ page, watch }) => {
		await open(page, '?shells=4&light=-1,1,1');
		expect(await state(page)).toBe('ready');
		await expect.poll(() => mark(page, 'fine')).toBeGreaterThan(0);
		const fur = (await mark(page, 'fur')) ?? 0;
		const begun = await page.evaluate(() =>
			performance.getEntriesByType('resource').flatMap(({ name, startTime }) => (/fine-/.test(name) ? startTime : [])),
		);
		expect(begun.length).toBeGreaterThan(2);
		expect(Math.min(...begun)).toBeGreaterThan(fur);
		expect(fine(watch)).toContain(`${site}models/fine-bunny/model.gltf`);
		// What comes from here on has them at once.
		const before = fine(watch).length;
		await page.getByRole('combobox', { name: 'Method', exact: true }).selectOption('Unlit');
		await expect.poll(() => state(page)).toBe('ready');
		expect(fine(watch)).toHaveLength(before);
	});

	test('planes=128 is ready when they are there, planes=64 never asks for them', async ({ page, watch }) => {
		await open(page, '?still=1&shells=4&planes=64');
		await page.waitForLoadState('networkidle');
		expect(fine(watch)).toEqual([]);
		await open(page, '?still=1&shells=4&planes=128');
		expect(await state(page)).toBe('ready');
		expect(await mark(page, 'fine')).toBeGreaterThan((await mark(page, 'fur')) ?? Number.POSITIVE_INFINITY);
	});

	test('who saves data stays with what there is', async ({ page, watch }) => {
		await page.addInitScript(() => {
			Object.defineProperty(navigator, 'connection', { value: { saveData: true } });
		});
		await open(page, '?still=1&shells=4');
		await page.waitForLoadState('networkidle');
		expect(fine(watch)).toEqual([]);
	});

	test('says so where those that were asked for cannot be had, and shows the others', async ({ page, watch }) => {
		await page.route('**/fine-bunny/plane1.png', (route) => route.abort());
		await open(page, '?still=1&shells=4&planes=128');
		expect(await state(page)).toBe('ready');
		await expect(page.locator('#notices')).toContainText('The finer planes cannot be shown: plane1.png');
		watch.complaints.splice(0);
	});
});
