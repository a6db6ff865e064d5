/** A lost context comes back, and what is disposed of is gone. */

import { expect, frames, open, state, test } from '../harness.ts';
import { drawNothing, shrinkPicture, watchGpu } from '../inPage/gpu.ts';
import { calm, canvasWidth, loseContext, middle, psnr, restyle, shot } from '../robust.ts';

/** Each loads one of two models. Counts must be equal to the object: what a round leaves, every round leaves. */
const ROUNDS = process.env.FURBAKE_TEST_ALL === '1' ? 50 : 10;

test.use({ viewport: { width: 100, height: 80 } });

for (const [what, query] of [
	['one body', calm],
	['a crowd', `${calm}&crowd=3`],
	['two methods', `${calm}&method=shadow-layers&split=eigen,0.5`],
] as const) {
	test(`a lost context comes back to the same picture of ${what}`, async ({ page }) => {
		await open(page, query);
		// Bodies of a crowd know the picture's height from its first frame on.
		for (const key of ['ArrowRight', 'ArrowLeft']) {
			await page.keyboard.press(key);
			await frames(page, 3);
		}
		const before = await shot(page);
		expect(middle(before).spread).toBeGreaterThan(2);
		for (let i = 0; i < 2; i++) {
			await loseContext(page);
			expect(psnr(before, await shot(page))).toBeGreaterThan(45);
		}
		// What belonged to the lost context is let go of without a word.
		await page.setViewportSize({ width: 120, height: 80 });
		await expect.poll(() => canvasWidth(page)).toBe(120);
	});
}

test('a lost context comes back while frames run, and the page goes on', async ({ page }) => {
	await page.setViewportSize({ width: 900, height: 500 });
	await shrinkPicture(page, 100, 75);
	await open(page, '?model=sphere&shells=4&light=-.8,.5,.3');
	await page.keyboard.press('ArrowRight');
	const rested = async () => {
		let last: Buffer = Buffer.alloc(0);
		await expect(async () => {
			const now = await page.locator('#picture').screenshot();
			const same = now.equals(last);
			last = now;
			expect(same && (await canvasWidth(page)) === 100).toBe(true);
		}).toPass({ intervals: [900] });
		return last;
	};
	const before = await rested();
	await loseContext(page);
	expect(psnr(before, await rested())).toBeGreaterThan(45);
	// What belonged to the lost context is let go of without a word.
	await page.getByRole('combobox', { name: 'Model' }).selectOption('Torus');
	await expect.poll(() => state(page)).toBe('ready');
	await restyle(page, '#picture { width: 80px !important; height: 60px !important }');
	await expect.poll(() => canvasWidth(page)).toBe(80);
	await frames(page, 3);
	await expect(page.locator('#overlay')).toContainText(/\d+ draw calls/);
});

test('rounds of loading and disposing leave the GPU as many objects as before', async ({ page }) => {
	await page.setViewportSize({ width: 900, height: 500 });
	// Objects are counted where they are made, whatever is drawn with them.
	await drawNothing(page);
	await watchGpu(page);
	await open(page, '?model=sphere&shells=2&still=1');
	const counts: Record<string, number>[] = [];
	for (let round = 0; round < ROUNDS; round++) {
		await page.evaluate(() => {
			document.documentElement.dataset.state = 'loading';
		});
		await page.getByRole('combobox', { name: 'Model' }).selectOption(round % 2 === 0 ? 'Torus' : 'Sphere');
		await expect.poll(() => state(page), { intervals: [20, 50] }).toBe('ready');
		if (round % 2 === 1) counts.push(await page.evaluate(() => window.gpu.live()));
	}
	expect(Object.values(counts[0] ?? {}).reduce((sum, count) => sum + count, 0)).toBeGreaterThan(20);
	for (const later of counts.slice(1)) expect(later).toEqual(counts[0]);
});
