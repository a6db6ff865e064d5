/** Fur under `scene.environment`, beside fur under a light probe of the same picture. */

import sky from '@pmndrs/assets/hdri/sky.exr.js';
import { expect, test } from '../harness.ts';
import { openInPage, served } from '../library.ts';

declare const loaded: typeof import('../inPage/environmentMap.ts');

test('fur is lit by an environment as by a light probe of it, turned and dimmed, where no probe is', async ({
	page,
}) => {
	await openInPage(page, 'environmentMap');
	const ball = served('public/models/sphere/model.gltf');
	const found = await page.evaluate(([ball, file]) => loaded.underEnvironment(ball, file), [
		ball,
		sky as string,
	] as const);
	for (const [way, decibels] of Object.entries(found))
		test.info().annotations.push({ type: way, description: decibels.toFixed(1) });
	for (const way of ['picture', 'pmrem', 'turned', 'rival', 'herd'] as const)
		expect(found[way], way).toBeGreaterThan(45);
	expect(found.live).toBeGreaterThan(40);
	expect(found.unturned).toBeLessThan(20);
	expect(found.beside).toBeGreaterThan(100);
	expect(found.dark).toBe(0);
});
