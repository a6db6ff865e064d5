/** The rivals of polynomial texture maps: the same fur in other light, maps drawn when they must be, nothing left over. */

import type { Page } from '@playwright/test';
import type { FurMethodName } from '../../../web/fur/index.ts';
import { expect, test } from '../harness.ts';
import type { RivalStage } from '../inPage/rivals.ts';
import { openInPage, served } from '../library.ts';

declare const rivals: RivalStage;

const METHODS = ['ptm', 'unlit', 'lengyel', 'shadow-layers'] as const satisfies FurMethodName[];

const openRivals = (page: Page) => openInPage(page, 'rivals');
const directed = served('public/models/torus-512/model.gltf');
const undirected = served('public/models/sphere/model.gltf');

for (const [what, url] of [
	['with directions', directed],
	['without directions, with a colour plane', undirected],
] as const) {
	test(`every method covers the same, in its own light: ${what}`, async ({ page }) => {
		await openRivals(page);
		const { pictures, error } = await page.evaluate(([u, names]) => rivals.pictures(u, names), [
			url,
			[...METHODS, 'ptm' as const],
		] as const);
		expect(error).toBe(0);
		const [ptm, unlit, lengyel, layers, again] = pictures;
		for (const { alphaApart } of pictures) expect(alphaApart).toBe(0);
		for (const rival of [unlit, lengyel, layers]) expect(rival?.apart).toBeGreaterThan(0.05);
		for (const rival of [lengyel, layers]) {
			expect(rival?.mean).toBeGreaterThan(0.7 * (ptm?.mean ?? 0));
			expect(rival?.mean).toBeLessThan(2.5 * (ptm?.mean ?? 0));
		}
		// What others have drawn in between leaves no trace.
		expect(again?.apart).toBe(0);
	});
}

for (const halfFloat of [true, false]) {
	test(`deep opacity maps of ${halfFloat ? 'half floats' : 'bytes'}: hairs shade hairs, the body its far side`, async ({
		page,
	}) => {
		await openRivals(page);
		const shade = await page.evaluate(([u, h]) => rivals.shade(u, { halfFloat: h }), [undirected, halfFloat] as const);
		test.info().annotations.push({ type: 'light', description: JSON.stringify(shade) });
		expect(shade.right).toBeLessThan(0.15 * shade.left);
		expect(shade.inner).toBeLessThan(0.2 * shade.outer);
		expect(shade.inner).toBeGreaterThan(0.01 * shade.outer);
	});
}

test('the maps are drawn anew when what they show has changed, and only then', async ({ page }) => {
	await openRivals(page);
	const { drew, again, moved } = await page.evaluate((u) => rivals.steps(u), directed);
	// Skin, hull, shells.
	for (const step of ['first', 'lamp', 'shells', 'model', 'back']) {
		expect(drew[step], step).toEqual({ drawn: true, calls: 3 });
	}
	for (const step of ['nothing', 'camera', 'intensity', 'farther']) {
		expect(drew[step], step).toEqual({ drawn: false, calls: 0 });
	}
	expect(moved).toBeGreaterThan(0.1);
	expect(again).toBe(0);
});

test('what a method has made is freed with it, and the shells have their own light again', async ({ page }) => {
	await openRivals(page);
	const { objects, own } = await page.evaluate(([u, names]) => rivals.leftOver(u, names, 4), [
		directed,
		[...METHODS],
	] as const);
	expect(own).toBe(true);
	expect(new Set(objects).size).toBe(1);
});

test('many lamps are the sum of them, those beyond the fourth too; the sky and a highlight make it brighter', async ({
	page,
}) => {
	await openRivals(page);
	const { means, apart, error } = await page.evaluate((u) => {
		const variants = [
			{},
			{ lamps: 6 },
			{ ambient: 1 },
			{ options: { highlight: 0.5 } },
			{ lamps: 6, options: { highlight: 0.5 } },
		];
		return rivals.variants(u, 'lengyel', variants);
	}, undirected);
	expect(error).toBe(0);
	const [one = 0, six = 0, sky = 0, shiny = 0] = means;
	expect(Math.abs(six - one)).toBeLessThan(0.01 * one);
	expect(apart[1]).toBeLessThan(0.05);
	expect(sky).toBeGreaterThan(1.05 * one);
	expect(shiny).toBeGreaterThan(1.02 * one);
});
