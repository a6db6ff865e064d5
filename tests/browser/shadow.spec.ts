/** Shadow maps on fur: what the bake has darkened is not darkened again, what others shade is. */

import { readFile } from 'node:fs/promises';
import type { Page } from '@playwright/test';
import { openModule } from '../../web/tools/browser.mjs';
import { expect, site, test } from './harness.ts';
import { repository, served } from './library.ts';

declare const loaded: typeof import('./shade.ts');

const MODEL = 'public/models/sphere/model.gltf';

/** The ball in a fur of one curve, that falls off to the dip. */
async function curved(page: Page): Promise<void> {
	const gltf = JSON.parse(await readFile(`${repository}${MODEL}`, 'utf8'));
	const fur = gltf.extensions.FUR_ptm_shells;
	const knots = Array.from({ length: 17 }, (_, x) => Math.min(x / 8, 1));
	fur.curves = { even: [[knots, knots, knots]], along: [[0, 0, 0].map(() => knots.map(() => 0))] };
	fur.version = '2.0';
	delete fur.environment;
	for (const pelt of fur.pelts) {
		pelt.weights = Array.from({ length: fur.layers }, () => [1]);
		delete pelt.fin.environment;
	}
	await page.route('**/sphere/model.gltf', (route) => route.fulfill({ json: gltf }));
}

for (const spot of [false, true]) {
	test(`a lone ball is as bright with a shadow map as without, in the shadow of another it is dark; spot: ${spot}`, async ({
		page,
	}) => {
		await openModule(page, site, served('tests/browser/shade.ts'));
		await curved(page);
		const eyes = await page.evaluate(([u, s]) => loaded.terminator(u, s), [served(MODEL), spot] as const);
		const brightest = Math.max(...eyes.flatMap(({ plain }) => plain.filter((value) => !Number.isNaN(value))));
		let [compared, below] = [0, 0];
		for (const { plain, mapped } of eyes)
			for (const [bin, value] of plain.entries()) {
				if (!(value > 0.01 * brightest)) continue;
				const ratio = (mapped[bin] ?? Number.NaN) / value;
				test.info().annotations.push({
					type: `n·l ${(bin / 10 - 0.95).toFixed(2)}`,
					description: `${value.toFixed(4)} ${ratio.toFixed(3)}`,
				});
				expect(ratio).toBeGreaterThan(0.9);
				expect(ratio).toBeLessThan(1.1);
				compared++;
				if (bin < 9) below++;
			}
		expect(compared).toBeGreaterThan(20);
		expect(below).toBeGreaterThan(3);
		// The other ball stands between lamp and ball, in the middle of the lit side.
		expect((eyes[0]?.behind[19] ?? 1) / (eyes[0]?.plain[19] ?? 0)).toBeLessThan(0.25);
		expect((eyes[0]?.behind[15] ?? 0) / (eyes[0]?.plain[15] ?? 1)).toBeGreaterThan(0.9);
	});
}
