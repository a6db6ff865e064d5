/** Fur that moves on the GPU moves as on the CPU, and leaves the renderer as it was. */

import { expect, test } from '../harness.ts';
import { openInPage, served } from '../library.ts';

declare const loaded: typeof import('../inPage/motion.ts');

test.beforeEach(({ page }) => openInPage(page, 'motion'));

for (const [name, jointed] of [
	['torus-512', false],
	['bunny', false],
	['bunny', true],
] as const)
	test(`${name}${jointed ? ', carried by bones' : ''}: CPU and GPU agree to 1e-3, from the frame on in which the GPU takes over`, async ({
		page,
	}) => {
		const url = served(`public/models/${name}/model.gltf`);
		const result = await page.evaluate(([url, jointed]) => loaded.agree(url, 3, jointed), [url, jointed] as const);
		test.info().annotations.push({ type: 'springs', description: JSON.stringify(result) });
		expect(result.processors).toEqual(['cpu', 'gpu']);
		expect(result.swung).toBeGreaterThan(0.4);
		expect(result.jump).toBeLessThan(1e-5);
		expect(result.apart).toBeLessThan(1e-3);
		expect(result.error).toBe(0);
	});

test('the renderer is as before, and a lost context leaves hairs at rest', async ({ page }) => {
	const result = await page.evaluate((url) => loaded.leaves(url), served('public/models/torus-512/model.gltf'));
	expect(result.kept).toEqual({
		target: true,
		box: [3, 4, 5, 6],
		view: [0, 0, 40, 30, 0, 0, 40, 30],
		scissor: true,
		autoClear: true,
		alpha: 0.5,
	});
	expect(result.swung).toBeGreaterThan(0.1);
	expect(result.after).toBeLessThan(0.05);
	expect(result.asleep).toBe(true);
	expect(result.error).toBe(0);
});

test('what the GPU would do more slowly stays on the CPU', async ({ page }) => {
	const { processor, swung, error } = await page.evaluate(
		(url) => loaded.slower(url),
		served('public/models/torus-512/model.gltf'),
	);
	expect([processor, error]).toEqual(['cpu', 0]);
	expect(swung).toBeGreaterThan(0.1);
});

test('a motion that ends leaves the body as it was baked, and what is dressed on it', async ({ page }) => {
	const { bent, processor, error } = await page.evaluate(
		(url) => loaded.ends(url),
		served('public/models/torus-512/model.gltf'),
	);
	expect(bent).toEqual([true, true, false, false, true, true, false, false]);
	expect([processor, error]).toEqual(['gpu', 0]);
});
