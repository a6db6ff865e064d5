/** A herd of a character: many bodies in a few draws, each in a pose of its own. */

import { character } from '../character.ts';
import { expect, test } from '../harness.ts';
import { openInPage, repository, served } from '../library.ts';

declare const loaded: typeof import('../inPage/herdPoses.ts');

const FOLDER = 'public/models/torus-512';
const MADE = served('made/model.gltf');

test.beforeEach(async ({ page }) => {
	const { json } = await character(FOLDER);
	await page.route('**/made/*', (route) => {
		const name = new URL(route.request().url()).pathname.split('/').at(-1) ?? '';
		return name === 'model.gltf' ? route.fulfill({ json }) : route.fulfill({ path: `${repository}${FOLDER}/${name}` });
	});
	await openInPage(page, 'herdPoses');
});

test('a herd of one character is the character, in its present pose and in a kept one', async ({ page }) => {
	const { present, kept, still } = await page.evaluate((url) => loaded.alone(url, 0.4), MADE);
	test.info().annotations.push({ type: 'dB', description: `${present.psnr.toFixed(1)}, ${kept.psnr.toFixed(1)}` });
	expect(Math.min(present.psnr, kept.psnr)).toBeGreaterThan(50);
	expect(Math.max(present.worst, kept.worst)).toBeLessThan(0.2);
	expect(still).toBe(0);
});

test('bodies of a herd stand in poses of their own, in three draws a level', async ({ page }) => {
	const bodies: [number, number][] = [
		[0.1, -2],
		[0.45, 0],
		[0.9, 2],
	];
	const { apart, unposed, levels, draws, calls } = await page.evaluate(([url, b]) => loaded.together(url, b), [
		MADE,
		bodies,
	] as const);
	test
		.info()
		.annotations.push({ type: 'dB', description: `${apart.psnr.toFixed(1)}, unposed ${unposed.psnr.toFixed(1)}` });
	expect(apart.psnr).toBeGreaterThan(50);
	expect(unposed.psnr).toBeLessThan(apart.psnr - 15);
	expect(draws).toBeLessThanOrEqual(2 * levels);
	// Fins, shells and skin with its eyes; ground and hull, skin and ground in the shadow map.
	expect(calls).toBeLessThanOrEqual(3 * levels + 4);
});
