/** The demo's highlights and light from behind, beside what is baked: little more light in front, a rim that glows. */

import type { BodyJob } from '../../../web/measure/bodyJob.ts';
import { expect, test } from '../harness.ts';
import type { Parts } from '../inPage/look.ts';
import { openInPage } from '../library.ts';

declare const loaded: typeof import('../inPage/look.ts');

/** The bunny from the front, in the light of L = 1; `furbake verify --body` traces these very cells. */
const eye: BodyJob['cells'][0]['eye'] = [-2.4126, 1.2691, 6.6344];
const JOB: BodyJob = {
	width: 120,
	height: 100,
	fieldOfView: 20,
	centre: [0.0017, 0.0244, 0.0012],
	radius: 1.254,
	irradiance: 14.784,
	cells: [
		{ name: 'front-frontleft', view: 'front', eye, lamp: [-0.6957, 0.65043, 0.30487] },
		{ name: 'front-behind', view: 'front', eye, lamp: [0.62416, 0.3513, -0.69787] },
	],
	methods: [],
	coloured: false,
	passes: 0,
	brightest: 0,
};

test('with the demo’s highlights and light from behind, the level stays, the rim glows and the face is dark', async ({
	page,
}) => {
	await openInPage(page, 'look');
	const cells = await page.evaluate(([url, job]) => loaded.parts(url, job), ['/models/bunny/model.gltf', JOB] as const);
	const [front, behind] = cells as [{ none: Parts; usual: Parts }, { none: Parts; usual: Parts }];
	test.info().annotations.push({ type: 'light', description: JSON.stringify(cells) });
	expect(front.usual.all / front.none.all).toBeGreaterThan(1.02);
	expect(front.usual.all / front.none.all).toBeLessThan(1.3);
	// Hairs that are traced with their own reflection have a rim as bright as fur that is lit from the front, or nearly.
	expect(behind.usual.rim).toBeGreaterThan(3 * behind.none.rim);
	expect(behind.usual.rim).toBeGreaterThan(0.4 * front.usual.all);
	expect(behind.usual.face).toBeLessThan(0.02 * behind.usual.rim);
});

test('highlights of near-black hairs leave them black', async ({ page }) => {
	await openInPage(page, 'look');
	const job = { ...JOB, width: 60, height: 50, cells: JOB.cells.slice(0, 1) };
	const [white = 0, black = 0] = await page.evaluate(
		([url, job]) =>
			loaded.shine(url, job, [
				[0.85, 0.85, 0.85],
				[0.02, 0.02, 0.02],
			]),
		['/models/bunny/model.gltf', job] as const,
	);
	test.info().annotations.push({ type: 'light', description: JSON.stringify({ white, black }) });
	expect(black).toBeLessThan(0.25 * white);
	expect(black).toBeGreaterThan(0.05 * white);
});
