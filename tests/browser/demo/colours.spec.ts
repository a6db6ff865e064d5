/** Fur is seen in the colours that were picked, by the page's light and tone mapping. */

import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { decode } from 'fast-png';
import {
	clipped,
	deltaE,
	hueApart,
	hueOf,
	litFur,
	meanColour,
	middleDisc,
} from '../../../web/tools/measure/colour.mjs';
import { toSwatch } from '../../../web/tools/measure/swatch.mjs';
import { root } from '../../../web/tools/process.mjs';
import { expect, open, site, test } from '../harness.ts';

const BALL = '?model=sphere&camera=0,0,1&light=0,.6,.8&still=1&ui=0';

test('lit fur keeps its hue up to the brightest, and hardly clips', async ({ page }) => {
	const shot = async (query: string) => {
		await open(page, `${BALL}&preset=fox${query}`);
		return decode(await page.screenshot());
	};
	const bright = await shot('');
	const fur = litFur(bright, await shot('&colour=0000ff,0000ff'));
	// Nothing of it reaches the shoulder of the tone mapping.
	const dim = hueOf(meanColour(await shot('&exposure=.25'), fur));
	const { hue, saturation } = hueOf(meanColour(bright, fur));
	expect(Math.abs(hueApart(hue, dim.hue))).toBeLessThan(1.5);
	expect(saturation / dim.saturation).toBeGreaterThan(0.95);
	expect(saturation / dim.saturation).toBeLessThan(1.05);
	expect(clipped(bright, fur)).toBeLessThan(0.02);
	test.info().annotations.push({ type: 'fox', description: `${hue} ${saturation} ${JSON.stringify(dim)}` });
});

test('fur that faces the lamp is seen in the picked colour', async ({ page }) => {
	for (const [picked, colour] of [
		['cb6e29', [0.597, 0.156, 0.022]],
		['8a8f99', [0.254, 0.275, 0.319]],
	] as const) {
		await open(page, `${BALL}&preset=bunny&colour=${picked},${picked}`);
		const picture = decode(await page.screenshot());
		const apart = deltaE(meanColour(picture, middleDisc(picture, 0.3)), [...colour]);
		test.info().annotations.push({ type: picked, description: `${apart}` });
		expect(apart).toBeLessThan(8);
	}
});

test('fox on the page is the fox of its swatch', { tag: '@long' }, async ({ page }) => {
	test.slow(); // four swatches, four pages
	const pelt = join(root, 'public', 'models', 'pelt-fox');
	const folder = test.info().outputPath();
	mkdirSync(folder, { recursive: true });
	const apart = await toSwatch(page, site, pelt, 'fox', folder);
	test.info().annotations.push({ type: 'fox', description: `${apart}` });
	expect(apart).toBeLessThan(5);
});
