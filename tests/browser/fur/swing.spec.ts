/** Hairs that swing: the same ones in shells, fins, shadows, rivals and herds; and no trace of it when they hang still. */

import { expect, test } from '../harness.ts';
import { openInPage, served } from '../library.ts';

declare const loaded: typeof import('../inPage/swing.ts');

test('fur that swings is as if it were combed there, and as before when it has come to rest', async ({ page }) => {
	await openInPage(page, 'swing');
	const swung = await page.evaluate((url) => loaded.swings(url), served('public/models/torus-512/model.gltf'));
	test.info().annotations.push({ type: 'swing', description: JSON.stringify(swung) });
	expect(swung.error).toBe(0);
	for (const [i, part] of ['all', 'shells', 'fins', 'shadow', 'lengyel', 'shadow-layers'].entries()) {
		expect(swung.alike[i], `${part}, dB`).toBeGreaterThan(50);
		expect(swung.moved[i], `${part}, dB`).toBeLessThan(43);
	}
	expect(swung.back, 'to the bit').toBe(true);
	expect(swung.active, 'programs that know of follicles before').toBe(false);
	expect(swung.relinked).toBe(0);
	expect(swung.redrawn, 'maps: first, nothing, swing, nothing, new version').toEqual([true, false, true, false, true]);
	expect(swung.worn, 'another fur of the body').toBeGreaterThan(50);
	expect(swung.crowd, 'a herd of one').toBeGreaterThan(50);
});
