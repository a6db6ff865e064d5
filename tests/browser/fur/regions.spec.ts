/** Several furs on one body: nothing is lost at their border, and nothing shows where it is. */

import { expect, test } from '../harness.ts';
import { floats, openInPage, served } from '../library.ts';

declare const loaded: typeof import('../inPage/regions.ts') &
	typeof import('../inPage/trim.ts') & { draw: typeof import('../inPage/herd.ts').draw };

/** A body in two furs with fins, in the colours of a picture. */
const tiger = served('public/models/tiger/model.gltf');

/** Share of the width at which the second fur of the golden square begins, and from which it is alone. */
const [FROM, TO] = [0.25, 0.75];

/** Width of a mean, columns: a tile of the square, whose hairs repeat. */
const TILE = 64;

/** Means over a tile around each column. */
const smooth = (values: number[]) =>
	Array.from(
		{ length: values.length - TILE },
		(_, i) => values.slice(i, i + TILE).reduce((sum, v) => sum + v, 0) / TILE,
	);

/** Share of the second fur by the file's own bounds, over the same tiles. */
const expected = (columns: number) =>
	smooth(
		Array.from({ length: columns }, (_, i) => Math.min(Math.max(((i + 0.5) / columns - FROM) / (TO - FROM), 0), 1)),
	);

const worst = (a: number[], b: number[]) => Math.max(...a.map((value, i) => Math.abs(value - (b[i] ?? Number.NaN))));

test('furs dissolve at their border: all of the light, by the shares that the file has', async ({ page }) => {
	await openInPage(page, 'regions');
	const urls = ['regions', 'regions-whole'].map((name) => served(`tests/golden/${name}/model.gltf`));
	const { alike, shining, calls, rivals, worn, found, error } = await page.evaluate(
		([several, whole]) => loaded.border(several as string, whole as string),
		urls,
	);
	const shares = expected(256);
	const off = Object.fromEntries(
		Object.entries(found).map(([name, { red, green }]) => {
			const both = red.map((part, i) => part + (green[i] as number));
			return [
				name,
				{
					share: worst(smooth(green), shares),
					light: worst(
						smooth(both),
						shares.map(() => 1),
					),
				},
			];
		}),
	);
	expect(error).toBe(0);
	expect(calls[1], 'draws of two furs').toBe(calls[0]);
	for (const decibels of alike) expect(decibels, 'the same fur in two regions and in one').toBeGreaterThan(50);
	expect(shining, 'with light from behind, for which varyings are left out').toBeGreaterThan(50);
	for (const decibels of rivals) expect(decibels, 'by other methods').toBeGreaterThan(50);
	expect(worn, 'dressed in one fur').toBeGreaterThan(50);
	expect(off.soft?.light, 'light lost or gained at the border').toBeLessThan(0.02);
	expect(off.soft?.share, 'share of a fur').toBeLessThan(0.065);
	// What these bounds are for.
	expect(off.hard?.share).toBeGreaterThan(0.1);
	expect(off.thin?.light).toBeGreaterThan(0.05);
	expect(off.double?.light).toBeGreaterThan(0.02);
});

/** Mean share of the far side in the quarters of a square, across or up; 256 cells of a quarter scatter by 0.03. */
const [NEAR, FAR] = [0.25, 0.75];

for (const [name, furs] of [
	['regions-3', ['left', 'right below', 'right above']],
	['regions-4', ['left below', 'right below', 'left above', 'right above']],
] as const)
	test(`${furs.length} furs at once everywhere are one, and each has its share and its own colours`, async ({
		page,
	}) => {
		await openInPage(page, 'regions');
		const urls = [name, 'regions-whole'].map((golden) => served(`tests/golden/${golden}/model.gltf`));
		const { alike, shares, error } = await page.evaluate(
			([several, whole]) => loaded.quarters(several as string, whole as string),
			urls,
		);
		expect(error).toBe(0);
		for (const decibels of alike) expect(decibels, 'the same fur in several regions and in one').toBeGreaterThan(50);
		expect(shares.length).toBe(furs.length);
		for (const [i, where] of furs.entries())
			for (let at = 0; at < 4; at++) {
				const [across, up] = [at % 2 ? FAR : NEAR, at > 1 ? FAR : NEAR];
				const x = where.includes('right') ? across : 1 - across;
				const y = where.includes('above') ? up : where.includes('below') ? 1 - up : 1;
				expect(Math.abs((shares[i]?.[at] as number) - x * y), `${where}, quarter ${at}`).toBeLessThan(0.1);
			}
	});

test('a body of two furs is cut as one of one fur is', async ({ page }) => {
	await openInPage(page, 'trim');
	const { each, same, error } = await page.evaluate((url) => loaded.shorn(url, [1, 0.4]), tiger);
	expect(error).toBe(0);
	expect(same, 'to the bit').toBe(true);
	const [long, short] = each;
	if (!long || !short) throw new Error('no pictures');
	for (const { rival } of each) expect(rival, 'coverage in other light').toBe(0);
	for (const figure of ['outline', 'shells', 'radius', 'finPixels', 'finRadius'] as const)
		expect(short[figure], figure).toBeLessThan(0.98 * long[figure]);
	expect(short.light / long.light).toBeGreaterThan(0.3);
	expect(short.light / long.light).toBeLessThan(1.3);
});

test('a herd of one body of two furs is that body, shining and in shadow', async ({ page }) => {
	await openInPage(page, 'herd');
	const wanted = {
		places: [[0, -0.3, 0, 0.4, 0.9]] as [number, number, number, number, number][],
		shiny: true,
		shadow: true,
		shorn: true,
	};
	const [plain, herd] = await page.evaluate(
		([url, how]) => Promise.all([loaded.draw(url, { ...how, as: 'plain' }), loaded.draw(url, how)]),
		[tiger, { ...wanted, eye: [0, 0.6, 5] as [number, number, number] }] as const,
	);
	const [a, b] = [floats(plain.picture), floats(herd.picture)];
	expect(a.some((value) => value > 0.5)).toBe(true);
	const error = a.reduce((sum, value, i) => sum + (value - (b[i] as number)) ** 2, 0) / a.length;
	expect(-10 * Math.log10(error)).toBeGreaterThan(50);
});
