/** Fur that is cut: shorter outlines, as much fur below the cut as there was, and light that gets to its roots. */

import { expect, test } from '../harness.ts';
import { openInPage, served } from '../library.ts';

declare const loaded: typeof import('../inPage/trim.ts');

const LENGTHS = [1, 0.6, 0.2];

test.beforeEach(({ page }) => openInPage(page, 'trim'));

test('shorter fur has a smaller outline, fewer shells and lower fins, and is the baked one again at its full length', async ({
	page,
}) => {
	const { each, same, error } = await page.evaluate(([url, lengths]) => loaded.shorn(url, lengths), [
		served('public/models/torus-512/model.gltf'),
		LENGTHS,
	] as const);
	test.info().annotations.push({ type: 'lengths', description: JSON.stringify(each) });
	expect(error).toBe(0);
	expect(same, 'to the bit').toBe(true);
	for (const [i, short] of each.entries()) {
		expect(short.rival, 'coverage in other light').toBe(0);
		const long = each[i - 1];
		if (!long) continue;
		for (const figure of ['outline', 'shells', 'radius', 'finPixels', 'finRadius'] as const)
			expect(short[figure], figure).toBeLessThan(0.98 * long[figure]);
		expect(short.light / long.light, 'light').toBeGreaterThan(0.3);
		expect(short.light / long.light, 'light').toBeLessThan(1.3);
	}
});

test('short fur still covers its skin, is about as bright, and minds less which side the light is on', async ({
	page,
}) => {
	const { each, error } = await page.evaluate(([url, lengths]) => loaded.stubble(url, lengths), [
		served('tests/golden/ptm-6/model.gltf'),
		LENGTHS,
	] as const);
	test.info().annotations.push({ type: 'lengths', description: JSON.stringify(each) });
	expect(error).toBe(0);
	const [whole, , short] = each;
	if (!whole || !short) throw new Error('no pictures');
	expect(short.covered).toBeLessThan(whole.covered);
	expect(short.covered).toBeGreaterThan(0.5 * whole.covered);
	expect(short.sidedness).toBeLessThan(whole.sidedness);
});
