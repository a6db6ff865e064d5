/** Wet and dirty fur: states on the GPU, mixed as numpy mixes them, loaded when they are wanted. */

import { readFile } from 'node:fs/promises';
import { expect, test } from '../harness.ts';
import { floats, openInPage, readFloats, repository, served } from '../library.ts';

declare const loaded: typeof import('../inPage/weather.ts');

const STATES = 'tests/golden/states';
const url = served(`${STATES}/model.gltf`);

test.beforeEach(({ page }) => openInPage(page, 'weather'));

test("wet, dry and muddy fur is as bright as numpy's mix of the states' bytes", async ({ page }) => {
	const { lights, weathers } = JSON.parse(await readFile(`${repository}${STATES}/weather.json`, 'utf8'));
	const expected = await readFloats(`${STATES}/weather.f32`);
	const radiance = floats(
		await page.evaluate(([u, l, w]) => loaded.weathers(u, l, w), [url, lights, weathers] as const),
	);
	expect(radiance).toHaveLength(expected.length);
	const each = expected.length / weathers.length;
	const worst = weathers.map((_: unknown, w: number) =>
		radiance
			.subarray(w * each, (w + 1) * each)
			.reduce((most, value, i) => Math.max(most, Math.abs(value - (expected[w * each + i] ?? Number.NaN))), 0),
	);
	test.info().annotations.push({ type: 'largest errors', description: JSON.stringify(worst) });
	for (const error of worst) expect(error).toBeLessThanOrEqual(1e-3);
});

test("each state's weights of the mean curves are mixed as its texels are", async ({ page }) => {
	const { lights, weathers } = JSON.parse(await readFile(`${repository}${STATES}/weather.json`, 'utf8'));
	const expected = await readFloats(`${STATES}/weather.f32`);
	const gltf = JSON.parse(await readFile(`${repository}${STATES}/model.gltf`, 'utf8'));
	const fur = gltf.extensions.FUR_ptm_shells;
	// A curve that is 1 above the horizon: what states of 1.x are, times a weight that each has of its own.
	const knots = Array.from({ length: 17 }, (_, x) => Math.min(x / 6, 1));
	fur.curves = { even: [[knots, knots, knots]], along: [[0, 0, 0].map(() => knots.map(() => 0))] };
	const shares = [1, 0.5, 1.2, 0.8, 1];
	for (const [i, pelt] of fur.pelts.entries()) {
		pelt.weights = [0, 1, 2, 3].map(() => [shares[i]]);
		delete pelt.fin.environment;
	}
	delete fur.environment;
	fur.version = '2.0';
	await page.route('**/states/model.gltf', (route) => route.fulfill({ json: gltf }));
	const radiance = floats(
		await page.evaluate(([u, l, w]) => loaded.weathers(u, l, w), [url, lights, weathers] as const),
	);
	const each = expected.length / weathers.length;
	const texels = each / lights.length;
	let worst = 0;
	radiance.forEach((value, i) => {
		if ((lights[Math.floor((i % each) / texels)]?.[2] ?? -1) < 0) return;
		const { wetness } = weathers[Math.floor(i / each)];
		const steps = [0, 0.5, 0.75, 1];
		const upper = Math.max(
			steps.findIndex((step) => step >= wetness),
			1,
		);
		const [from = 0, to = 1] = [steps[upper - 1], steps[upper]];
		const part = (wetness - from) / (to - from);
		const share = (shares[upper - 1] ?? 0) * (1 - part) + (shares[upper] ?? 0) * part;
		worst = Math.max(worst, Math.abs(value - share * (expected[i] ?? Number.NaN)));
	});
	expect(worst).toBeLessThan(2e-3);
});

test('dry fur is drawn as if there were no weather; a light tier holds two states, and draws the same', async ({
	page,
}) => {
	const all = await page.evaluate((u) => loaded.course(u), url);
	const layers = 4;
	expect(all.unloaded).toEqual({ parts: [], same: 0, depths: [layers, layers, 1], has: { wet: true, dirt: true } });
	expect(all.dry).toEqual({ parts: [], same: 0, depths: [5 * layers, 5 * layers, 5] });
	expect(all.soaking).toEqual({ parts: ['WET'], differs: expect.any(Number) });
	expect(all.soaking.differs).toBeGreaterThan(0.5);
	expect(all.muddy).toEqual({ parts: ['WET', 'DIRTY', 'MUD'], differs: expect.any(Number) });
	expect(all.muddy.differs).toBeGreaterThan(0.5);
	expect(all.clean, 'bytes as before').toEqual({ parts: [], same: 0 });
	expect(all.depths).toEqual([
		[layers, layers, 1],
		[2 * layers, 2 * layers, 2],
		[layers, layers, 1],
	]);
	for (const difference of all.tier) expect(difference).toBeLessThan(1e-5);
	expect(all.lightMud.parts).toEqual(['WET', 'DIRTY']);
	expect([all.left, all.error], 'the two targets that were drawn to').toEqual([2, 0]);
});

test('on a light tier the pelt that a body is dressed in takes no room for its own dry fur, which nobody sees', async ({
	page,
}) => {
	expect(await page.evaluate((u) => loaded.worn(u, 0.6), url)).toEqual([0.5, 0.75]);
});

test('with every switch of the shaders, in rivals and in herds, wet fur is darker and muddy fur is darker still', async ({
	page,
}) => {
	const { ratios, rivals, dressed, herd, error } = await page.evaluate((u) => loaded.switches(u), url);
	for (const [wet = 1, muddy = 1] of Object.values(ratios)) {
		expect(wet).toBeLessThan(0.95);
		expect(muddy).toBeLessThan(wet);
	}
	for (const wet of rivals) expect(wet).toBeLessThan(0.8);
	expect(dressed).toBe(true);
	expect(herd, 'levels and fins').toBeGreaterThan(1);
	expect(error).toBe(0);
});

test('rain on a corner is seen there only', async ({ page }) => {
	const { before, after, driest, wettest } = await page.evaluate((u) => loaded.corner(u), url);
	expect(driest).toBe(0);
	expect(wettest).toBeGreaterThan(0.9);
	const touched = before.map((value, i) => value !== after[i]);
	const share = touched.filter(Boolean).length / touched.length;
	expect(share).toBeGreaterThan(0.1);
	expect(share).toBeLessThan(0.9);
	const mean = (of: number[]) => of.reduce((sum, value, i) => sum + (touched[i] ? value : 0), 0);
	expect(mean(after) / mean(before)).toBeLessThan(0.95);
});

test('states are fetched when they are wanted, not before; a failure is one sentence, and can be tried again', async ({
	page,
	watch,
}) => {
	let broken = true;
	await page.route('**/wet-plane1.png', (route) => {
		if (!broken) return route.continue();
		broken = false;
		return route.fulfill({ status: 404, body: '' });
	});
	const dry = ['plane0.png', 'plane1.png', 'fin0.png', 'fin1.png'];
	watch.requests.length = 0;
	const said = await page.evaluate((u) => loaded.attempts(u, 0), url);
	const pictures = () => watch.requests.filter((address) => address.endsWith('.png')).map((a) => a.split('/').at(-1));
	expect(pictures().sort()).toEqual(dry.sort());
	expect(said).toEqual([]);
	const [first, second] = await page.evaluate((u) => loaded.attempts(u, 2), url);
	expect(first?.[0]).toMatch(/^wet-plane1\.png: could not be loaded \([^\n]*404[^\n]*\)$/);
	expect(first?.[1]).toBe(4);
	expect(second).toEqual(['loaded', 20]);
	expect(watch.complaints.splice(0).join()).toContain('404');
});

test('states of files that are taken back after loading are there', async ({ page }) => {
	expect(await page.evaluate((u) => loaded.dropped(u), url)).toEqual([20, 20, 5]);
});
