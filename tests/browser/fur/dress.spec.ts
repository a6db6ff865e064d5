/** Furs of one body: in another's pelt, side by side, denser and longer. */

import { expect, test } from '../harness.ts';
import { openInPage, served } from '../library.ts';

declare const loaded: typeof import('../inPage/dress.ts');

const model = (name: string) => served(`public/models/${name}/model.gltf`);

test.beforeEach(({ page }) => openInPage(page, 'dress'));

test('a body in the pelt that it was baked with looks as it does undressed, in another one otherwise', async ({
	page,
}) => {
	const urls = [model('bunny'), model('pelt-bunny'), model('pelt-fox')] as const;
	const worn = await page.evaluate((all) => loaded.wardrobe(...all), urls);
	expect(worn.alike, 'dB').toBeGreaterThan(45);
	expect(worn.bunny.length).toBeCloseTo(worn.bunny.expected.length, 4);
	expect(worn.bunny.tiles).toBeCloseTo(worn.bunny.expected.tiles ?? 1, 3);
	expect(worn.bareIsSmaller).toBe(true);
	expect(worn.other).toBeLessThan(30);
	expect(worn.method, 'another method shows').toBeLessThan(40);
	// A herd finds its light at each shell.
	expect(worn.herd, 'a herd of one').toBeGreaterThan(54);
	expect(worn.last, 'the body undressed again').toBe(0);
	expect(worn.kept, 'textures of body and pelt').toBe(true);
	expect(worn.error).toBe(0);
});

test('two furs share a picture, each in its own columns', async ({ page }) => {
	const { left, early, roots, differences, error } = await page.evaluate(
		(url) => loaded.split(url, 0.4),
		model('torus-512'),
	);
	expect(early, 'before there is any fur').toEqual(['skin']);
	expect(roots, 'share of the colour of roots').toBeCloseTo(0.35);
	expect(differences).toEqual({
		left: 0,
		right: 0,
		swapped: expect.any(Number),
		bare: expect.any(Number),
		whole: 0,
		lower: 0,
		upper: 0,
	});
	expect(differences.swapped).toBeGreaterThan(0.1);
	expect(differences.bare).toBeGreaterThan(0.1);
	// One texture is three's own, a table for the skin's reflections.
	expect(left).toEqual({ geometries: 0, textures: 1 });
	expect(error).toBe(0);
});

test('denser fur covers more, longer fur reaches farther, whatever it is lit by', async ({ page }) => {
	const { crowd, densities, light, rivals, maps, lengths, herds, error } = await page.evaluate(
		(url) => loaded.cover(url),
		model('torus-512'),
	);
	const [thin = 0, usual = 0, dense = 0] = densities;
	expect(usual / thin).toBeGreaterThan(1.1);
	expect(dense / usual).toBeGreaterThan(1.02);
	expect((light[1] ?? 0) / (light[0] ?? 0), 'light of what is covered').toBeCloseTo(1, 0);
	expect(rivals.same, 'made before or after').toBe(0);
	expect(rivals.thinner).toBeLessThan(0.99);
	expect(maps).toEqual({ drawn: true, denser: expect.any(Number), densityByRival: 2 });
	expect(maps.denser).toBeGreaterThan(1.01);

	const [short, baked, long] = lengths;
	if (!short || !baked || !long) throw new Error('no pictures');
	for (const [less, more] of [
		[short, baked],
		[baked, long],
	] as const) {
		expect(more.outline / less.outline).toBeGreaterThan(1.02);
		expect(more.shells).toBeGreaterThanOrEqual(less.shells);
		expect(more.radius).toBeGreaterThan(less.radius);
		expect(more.fins).toBeGreaterThan(less.fins);
	}
	expect(crowd).toEqual({ denser: expect.any(Number), left: 0, right: expect.any(Number) });
	expect(crowd.denser).toBeGreaterThan(1.005);
	expect(crowd.right).toBeGreaterThan(0.1);
	expect((herds[0] ?? 0) / (herds[1] ?? 0), 'of a herd').toBeGreaterThan(1.02);
	expect(error).toBe(0);
});
