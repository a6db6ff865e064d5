/** Several furs on one body: nothing is lost at their border, and nothing shows where it is. */

import { expect, test } from '../harness.ts';
import { openInPage, served } from '../library.ts';

declare const loaded: typeof import('../inPage/regions.ts');

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
	expect(off.soft?.share, 'share of a fur').toBeLessThan(0.06);
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
