/** Colour of light that met several hairs, in the shaders: as TypeScript has it, for lamps and sky, shells and fins. */

import { readFile } from 'node:fs/promises';
import type { Page } from '@playwright/test';
import type { FurAsset, Multiple } from '../../../web/fur/format.ts';
import { expect, test } from '../harness.ts';
import type { Stage } from '../inPage/stage.ts';
import { floats, leaning, openStage, readAsset, repository, served } from '../library.ts';

declare const stage: Stage;

const folder = 'tests/golden/ptm-6-curves';
const file = `${folder}/model.gltf`;

const multiple: Multiple = {
	albedo: 0.8,
	shares: [
		[1, -0.2, 0],
		[0.8, -0.3, 0.1],
		[0.5, 0.1, 0.05],
		[0.2, 0.3, -0.05],
	],
	ratio: [1, 0.95, 0.8, 0.6],
	seen: [0.1, 0.2, 0.3, 0.4],
	tint: [0.7, 0.8, 0.9, 1],
};

const gainOf = (k: number, colour: number, [ratio, tint] = [multiple.ratio[k] ?? 0, multiple.tint[k] ?? 0]) =>
	((colour * tint) / multiple.albedo) * ((1 - ratio * multiple.albedo) / (1 - ratio * colour * tint));

const shareOf = (k: number, height: number, radius: number) => {
	const [even = 0, steep = 0, body = 0] = multiple.shares[k] ?? [];
	return even + steep * Math.sqrt(height) + (3 * body * (radius - 1)) / (2 * radius + 1);
};

/** Serves the golden asset with hairs of one colour, and with what it tells of it or without. */
async function serve(page: Page, colour: number, told: boolean): Promise<FurAsset> {
	const gltf = JSON.parse(await readFile(`${repository}${file}`, 'utf8'));
	const fur: FurAsset = gltf.extensions.FUR_ptm_shells;
	for (const end of ['root', 'tip', 'tip2'] as const) fur.ramp[end] = [colour, colour, colour];
	for (const pelt of fur.pelts) if (told) pelt.multiple = multiple;
	await page.unrouteAll();
	await page.route('**/ptm-6-curves/model.gltf', (route) => route.fulfill({ json: gltf }));
	return fur;
}

/** What each lit texel has of what it would have without. */
async function ratios(page: Page, colour: number, draw: () => Promise<number[]>): Promise<number[]> {
	await serve(page, colour, false);
	const before = await draw();
	await serve(page, colour, true);
	const after = await draw();
	const lit = before.flatMap((light, i) => (light > 0.02 * colour ? [(after[i] ?? Number.NaN) / light] : []));
	expect(lit.length).toBeGreaterThan(10);
	return lit;
}

const curvature = (radius: number) => [1 / (0.5 * radius), 1 / (0.5 * radius), 0];
const tip2 = (colour: number) => [colour, colour, colour] as [number, number, number];

for (const [name, look] of [
	['of one hue', {}],
	['of several hues', { blue: true }],
	['per fragment', { perFragment: true }],
] as const) {
	test(`lamps ${name} have the share of their height and the gain of the hairs' colour`, async ({ page }) => {
		await openStage(page);
		const { fur } = await readAsset(folder);
		for (const [layer, colour, radius, lamp] of [
			[3, 0.3, 4, [0.3, 0.2, 0.93]],
			[2, 0.6, 16, [0.8, -0.5, 0.33]],
			[1, 0.95, 1, [-0.6, 0.6, 0.53]],
			[2, 0.3, 1, [0.4, -0.8, -0.45]], // opposite the eye
		] as const) {
			const found = await ratios(page, colour, async () => {
				const drawn = await page.evaluate(([url, k, a, l]) => stage.vertices(url, k, a, l), [
					served(file),
					layer,
					{ curvature: curvature(radius) } as Record<string, number[]>,
					{ lamp: [...lamp] as number[], tip2: tip2(colour), ...look },
				] as const);
				return drawn.light;
			});
			const height = lamp[2] / Math.hypot(...lamp);
			const straight = shareOf(layer, Math.max(height, 0), radius);
			const share = Math.min(Math.max(straight * leaning(fur, lamp, Math.max(-height, 0)), 0), 1);
			const expected = 1 + share * (gainOf(layer, colour) - 1);
			for (const ratio of found) expect(ratio).toBeCloseTo(expected, 2);
			expect(Math.abs(expected - 1)).toBeGreaterThan(0.03);
		}
	});
}

test("the sky has one share for all directions, by the skin's curvature", async ({ page }) => {
	await openStage(page);
	for (const [radius, ...between] of [
		[1, 1],
		[74 / 11, 4, 16], // 1/(β + 1) half-way between those of the tabulated ones
	] as const) {
		await serve(page, 0.4, true);
		let share = 0;
		for (const tabulated of between) {
			const shares = await page.evaluate(([url, r]) => stage.skyShares(url, r), [served(file), tabulated] as const);
			share += (shares[2] ?? Number.NaN) / between.length;
		}
		const found = await ratios(page, 0.4, async () => {
			const drawn = await page.evaluate(([url, attributes, look]) => stage.vertices(url, 2, attributes, look), [
				served(file),
				{ curvature: curvature(radius) } as Record<string, number[]>,
				{ ambient: 3, tip2: tip2(0.4) },
			] as const);
			return drawn.light;
		});
		const expected = 1 + share * (gainOf(2, 0.4) - 1);
		for (const ratio of found) expect(ratio).toBeCloseTo(expected, 2);
	}
});

test('fins mix the slabs by height', async ({ page }) => {
	await openStage(page);
	const fur = await serve(page, 0.5, true);
	const { pelts, layers } = fur;
	const { width = 0, height = 0 } = pelts[0]?.fin ?? {};
	const lamp = [0.3, 0.8, 0.5];
	const draw = async () =>
		floats(
			await page.evaluate(([url, l, c]) => stage.heights(url, l, c), [
				served(file),
				[lamp] as number[][],
				curvature(4),
			] as const),
		);
	await serve(page, 0.5, false);
	const before = await draw();
	await serve(page, 0.5, true);
	const after = await draw();
	const up = 0.8 / Math.hypot(...lamp);
	let compared = 0;
	for (let row = 0; row < height; row++) {
		const slab = Math.min(Math.max(((row + 0.5) / height) * layers - 0.5, 0), layers - 1);
		const below = Math.floor(slab);
		const mixed = (of: (k: number) => number) =>
			of(below) + (slab - below) * (of(Math.min(below + 1, layers - 1)) - of(below));
		const [ratio, tint] = [mixed((k) => multiple.ratio[k] ?? 0), mixed((k) => multiple.tint[k] ?? 0)];
		const factor = mixed((k) => (1 - (multiple.ratio[k] ?? 0) * multiple.albedo) / multiple.albedo);
		const share = mixed((k) => shareOf(k, up, 4)) * leaning(fur, [0.5, 0.3, 0.8]); // a fin's axes are B, N, T
		const expected = 1 + share * ((0.5 * tint * factor) / (1 - ratio * 0.5 * tint) - 1);
		for (let column = 0; column < width; column++) {
			const light = before[row * width + column] ?? 0;
			if (light < 0.05) continue;
			expect((after[row * width + column] ?? 0) / light).toBeCloseTo(expected, 2);
			compared++;
		}
	}
	expect(compared).toBeGreaterThan(10);
});
