/** Fur in the fog of a scene, with logarithms of depths, and multisampled, as everything else in it. */

import { expect, test } from '../harness.ts';
import { openInPage, served } from '../library.ts';

declare const loaded: typeof import('../inPage/air.ts');

const MODEL = served('public/models/sphere/model.gltf');

for (const method of [undefined, 'lengyel'] as const) {
	test(`fog hides fur as far as it hides what stands there; ${method ?? 'its own light'}`, async ({ page }) => {
		await openInPage(page, 'air');
		const [clear, hidden, far, half] = await page.evaluate(([url, m]) => loaded.foggy(url, 0x0000ff, m), [
			MODEL,
			method,
		] as const);
		const [red = 0, green = 0, blue = 0] = clear ?? [];
		expect(red).toBeGreaterThan(0.1);
		expect(hidden).toEqual([0, 0, 1, 1].map((value) => expect.closeTo(value, 3)));
		expect(far).toEqual(clear?.map((value) => expect.closeTo(value, 5)));
		// The ball's front is nearer than its middle by an eighth of the way: .58 of it is left there.
		const left = (half?.[0] ?? 0) / red;
		expect(left).toBeGreaterThan(0.5);
		expect(left).toBeLessThan(0.6);
		expect(half?.[1]).toBeCloseTo(left * green, 2);
		expect(half?.[2]).toBeCloseTo(left * blue + 1 - left, 2);
	});
}

test('logarithms of depths change nothing', async ({ page }) => {
	await openInPage(page, 'air');
	expect(await page.evaluate((url) => loaded.logarithmic(url), MODEL)).toBeGreaterThan(60);
});

test('pixels of several samples are no darker than black beyond the edges of triangles', async ({ page }) => {
	await openInPage(page, 'air');
	expect(await page.evaluate((url) => loaded.least(url), served('public/models/bunny/model.gltf'))).toBe(0);
});
