/** The light of a place: its harmonics, where they are, and fur under them against fur under as many lamps. */

import sky from '@pmndrs/assets/hdri/sky.exr.js';
import sunset from '@pmndrs/assets/hdri/sunset.exr.js';
import { expect, test } from '../harness.ts';
import type { Stage } from '../inPage/stage.ts';
import { openStage, served } from '../library.ts';

declare const stage: Stage;

test("a picture's harmonics are three's own of its cube map, and its sun is where the background shows it", async ({
	page,
}) => {
	await openStage(page);
	const [smooth, sunny] = [
		await page.evaluate((file) => stage.oracle(file), sunset as string),
		await page.evaluate((file) => stage.oracle(file), sky as string),
	];
	const size = Math.hypot(...smooth.three.flat());
	smooth.ours.forEach((coefficient, j) => {
		coefficient.forEach((value, c) => {
			expect(Math.abs(value - (smooth.three[j]?.[c] ?? Number.NaN)), `harmonic ${j}`).toBeLessThan(0.005 * size);
		});
	});
	expect(Math.max(...sunny.seen)).toBeGreaterThan(50 * sunny.mean);
});

for (const [name, picture, bounds, tag] of [
	['a sunset', sunset as string, [0.072, 0.06], []],
	['a sun above the sea', sky as string, [0.145, 0.03], ['@long']],
] as const) {
	test(`fur under the moments of ${name} is as under lamps all around`, { tag: [...tag] }, async ({ page }) => {
		test.slow();
		await openStage(page);
		const figures = await page.evaluate(([model, file, options]) => stage.surroundings(model, file, options), [
			served('public/models/bunny/model.gltf'),
			picture,
			{ width: 96, height: 72, shells: 6, lamps: 256, views: 1 },
		] as const);
		expect(figures.lamps).toBeGreaterThan(200);
		expect(figures.shares.length).toBeGreaterThan(0);
		const [view] = figures.views;
		expect(view?.pixels).toBeGreaterThan(1000);
		const [plain, lamp] = view?.moments ?? [];
		for (const [i, moments] of [plain, lamp].entries()) {
			const { rmse = Number.NaN, bias = Number.NaN } = moments ?? {};
			test.info().annotations.push({ type: `with ${i} lamps apart`, description: `${rmse} rms, ${bias} bias` });
			expect(rmse).toBeLessThan(bounds[i] ?? 0);
			// Four mean curves below the horizon: up to .071 with the sun among the moments.
			expect(Math.abs(bias), `bias with ${i} lamps apart`).toBeLessThan(0.075);
		}
		expect(lamp?.rmse).toBeLessThan(plain?.rmse ?? 0);
	});
}
