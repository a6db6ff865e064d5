/** Many bodies of one asset on the GPU: what they look like, and what they cost. */

import type { Page } from '@playwright/test';
import { expect, test } from '../harness.ts';
import type { Drawn, Place, Wanted } from '../inPage/herd.ts';
import { floats, openInPage, served } from '../library.ts';

declare const loaded: typeof import('../inPage/herd.ts');

const bunny = served('public/models/bunny/model.gltf');
const sphere = served('public/models/sphere/model.gltf');

test.beforeEach(({ page }) => openInPage(page, 'herd'));

function draw(page: Page, url: string, wanted: Wanted): Promise<Drawn> {
	return page.evaluate(([u, w]) => loaded.draw(u, w), [url, wanted] as const);
}

/**
 * Largest difference, and peak signal to noise in decibels, of two pictures in 0..1.
 *
 * @param left pixels of the largest difference that do not count: rounding decides which side of an edge they are on
 */
function compare(one: Drawn, other: Drawn, left = 0): { worst: number; psnr: number } {
	const [a, b] = [floats(one.picture), floats(other.picture)];
	const pixels = Array.from({ length: a.length / 4 }, (_, pixel) => {
		const off = [0, 1, 2, 3].map((c) => (a[4 * pixel + c] ?? 0) - (b[4 * pixel + c] ?? Number.NaN));
		return { worst: Math.max(...off.map(Math.abs)), sum: off.reduce((sum, value) => sum + value * value, 0) };
	});
	const counted = pixels.sort((one, other) => other.worst - one.worst).slice(left);
	const worst = counted[0]?.worst ?? Number.NaN;
	const sum = counted.reduce((total, pixel) => total + pixel.sum, 0);
	test.info().annotations.push({ type: 'largest difference', description: worst.toExponential(2) });
	return { worst, psnr: -10 * Math.log10(sum / a.length) };
}

/** Rows of bodies, those behind farther and farther away. */
function rows(count: number): Place[] {
	return Array.from({ length: count }, (_, i) => {
		const [row, column] = [Math.floor(i / 10), i % 10];
		return [(column - 4.5) * (0.9 + row / 3), -0.5, -1.1 * row ** 1.5, i, 0.9 + (i % 5) / 20];
	});
}

for (const [what, wanted] of [
	['near', { places: [[0.2, 0, 0, 0.4, 0.9]], eye: [0, 1, 3.5] }],
	['far', { places: [[-0.5, 0.2, 0, -2, 1.1]], eye: [3, 4, 12] }],
	['by parallel rays', { places: [[0, 0, 0, 1, 1.2]], parallel: true }],
	['shiny', { places: [[0.2, 0, 0, 1, 1.2]], shiny: true }],
	['with shadows', { places: [[0.2, 0, 0, 1, 1.2]], shadow: true }],
] as [string, Wanted][]) {
	test(`one body is the plain fur: ${what}`, async ({ page }) => {
		const plain = await draw(page, bunny, { ...wanted, shorn: true, as: 'plain' });
		const one = await draw(page, bunny, { ...wanted, shorn: true });
		const { worst, psnr } = compare(plain, one, wanted.shadow ? 12 : 4);
		// Rounding decides which side of a shadow's edge a few fragments are on; highlights are up to 3 times as bright.
		// Joints of one body are rounded otherwise than those of many, by .012 at most; the more combed hairs hide, and
		// the more light depends on the eye, the more it shows.
		// Smooth parts are drawn with the skin, whose highlights end with its smoothness.
		expect(psnr).toBeGreaterThan(53);
		expect(worst).toBeLessThan(wanted.shadow ? 0.22 : 0.1);
		expect(floats(one.picture).some((value, i) => i % 4 < 3 && value > 0.3)).toBe(true);
	});
}

test('a hundred bodies are three draws a level, and bodies of a level have shells enough', async ({ page }) => {
	const places = rows(100);
	await page.evaluate(() => loaded.blind());
	const { calls, levels } = await draw(page, bunny, { places, size: 480, eye: [0, 0.6, 3.2], target: [0, 0, -10] });
	expect(levels.length).toBeGreaterThanOrEqual(3);
	expect(calls).toBeLessThanOrEqual(3 * levels.length);
	// From far to near, none coarser than the one before.
	const most = levels.map(([shells]) => shells);
	expect(most).toEqual([...most].sort((a, b) => a - b));
	const seen = levels.reduce((sum, [, bodies]) => sum + bodies, 0);
	expect(seen).toBeGreaterThan(40);
	expect(seen).toBeLessThan(100);
});

test('what is outside the frustum costs nothing', async ({ page }) => {
	const eye: [number, number, number] = [0, 0, 9];
	const inside: Place[] = [
		[0, 0, 0],
		[1.2, 0, -3],
	];
	const outside: Place[] = [
		[0, 0, 12],
		[20, 0, 0],
		[0, -15, 0],
		[0, 0, -400],
	];
	const few = await draw(page, sphere, { places: inside, eye });
	const all = await draw(page, sphere, { places: [...outside, ...inside], eye });
	expect([all.calls, all.triangles, all.levels]).toEqual([few.calls, few.triangles, few.levels]);
	expect(compare(all, few).worst).toBe(0);
	const none = await draw(page, sphere, { places: outside, eye });
	expect([none.calls, none.triangles]).toEqual([0, 0]);
	// Only its fur reaches into the picture.
	const edge = await draw(page, sphere, { places: [[9 * Math.tan(Math.PI / 12) + 1.1, 0, 0]], eye });
	expect(edge.triangles).toBeGreaterThan(0);
});

const crowd: Place[] = [
	[-0.3, 0, 1.5, 0.4, 0.8],
	[0.3, 0, -1, -0.5, 1.2],
	[0.9, 0, 0.6, 2, 0.7],
	[-1.1, 0, -2.6, 1, 1.3],
];

test('the picture does not know in which order bodies were added', async ({ page }) => {
	const [a, b, c, d] = crowd as [Place, Place, Place, Place];
	const forward = await draw(page, bunny, { places: [a, b, c, d] });
	for (const places of [
		[d, c, b, a],
		[b, d, a, c],
	])
		expect(compare(forward, await draw(page, bunny, { places })).worst).toBe(0);
});

test('fur blends over the fur behind it, within a level and between levels', async ({ page }) => {
	const shells = { places: crowd, fins: false, levels: [24] };
	const together = await draw(page, bunny, shells);
	expect(together.levels).toEqual([[24, 4]]);
	expect(compare(together, await draw(page, bunny, { ...shells, as: 'each' })).psnr).toBeGreaterThan(60);

	const behind: Place[] = [
		[0, 0, 4.4],
		[0.4, 0.3, -8, 1, 2],
	];
	const levels = { places: behind, size: 320 };
	const apart = await draw(page, bunny, levels);
	expect(apart.levels).toHaveLength(2);
	expect(compare(apart, await draw(page, bunny, { ...levels, as: 'each' })).psnr).toBeGreaterThan(60);
});

test('nothing pops where a body goes from level to level', async ({ page }) => {
	// As many shells as slabs: shells on the border of two slabs would show the one or the other.
	const wanted: Wanted = { places: [[0, 0, 0]], eye: [0, 0, 9], size: 480, levels: [96, 16, 6] };
	const [finer, coarser] = await page.evaluate(([url, w]) => loaded.border(url, w, 16), [sphere, wanted] as const);
	expect([finer.levels, coarser.levels]).toEqual([[[96, 1]], [[16, 1]]]);
	expect(compare(finer, coarser).psnr).toBeGreaterThan(60);
});

/** Mean light of two pictures over each other, and their peak signal to noise as the eye sees 4 × 4 pixels, decibels. */
function alike(one: Drawn, other: Drawn, side: number): { brighter: number; psnr: number } {
	const [a, b] = [one, other].map(({ picture }) => {
		const quarter = new Float64Array((3 * side * side) / 16);
		for (const [i, value] of floats(picture).entries()) {
			const [pixel, c] = [i >> 2, i & 3];
			const at = ((pixel % side) >> 2) + (side >> 2) * (Math.floor(pixel / side) >> 2);
			if (c < 3) quarter[3 * at + c] = (quarter[3 * at + c] as number) + value / 16;
		}
		return quarter;
	}) as [Float64Array, Float64Array];
	const light = ([...values]: Float64Array) => values.reduce((sum, value) => sum + value, 0);
	const tone = (value: number) => Math.min(value, 1) ** (1 / 2.2);
	const furry = [...a.keys()].filter((i) => Math.max(a[i] as number, b[i] as number) > 0.01);
	const square = furry.reduce((sum, i) => sum + (tone(a[i] as number) - tone(b[i] as number)) ** 2, 0) / furry.length;
	return { brighter: light(b) / light(a), psnr: -10 * Math.log10(square) };
}

for (const [name, url] of [
	['bunny', bunny],
	['tiger', served('public/models/tiger/model.gltf')],
] as const) {
	test(`bodies far away look alike on fewer faces: ${name}`, async ({ page }) => {
		const places = rows(12).map(([x, y, z, ...turned], i): Place => [(i % 4) - 1.5 + x / 40, y, z - 4, ...turned]);
		const wanted: Wanted = { places, size: 240, eye: [0, 2, 9], target: [0, 0, -4], shorn: true };
		const all = await draw(page, url, wanted);
		const fewer = await draw(page, url, { ...wanted, far: 'fewer' });
		expect(Math.max(...all.levels.map(([shells]) => shells))).toBeLessThanOrEqual(12);
		expect([fewer.calls, fewer.levels]).toEqual([all.calls, all.levels]);
		expect(fewer.triangles / all.triangles).toBeLessThan(name === 'tiger' ? 0.7 : 0.4);
		const { brighter, psnr } = alike(all, fewer, 240);
		test.info().annotations.push({ type: 'alike', description: `${psnr.toFixed(1)} dB, light ${brighter.toFixed(3)}` });
		expect(Math.abs(brighter - 1)).toBeLessThan(0.035);
		expect(psnr).toBeGreaterThan(32);
	});
}

test('without a simplifier only overlaps are left out, and near bodies keep all', async ({ page }) => {
	const far: Wanted = { places: [[0, 0, 0, 1]], eye: [0, 2, 20], levels: [12], size: 160 };
	const [all, apart] = [await draw(page, bunny, far), await draw(page, bunny, { ...far, far: 'apart' })];
	expect(apart.triangles).toBeLessThan(0.9 * all.triangles);
	expect(alike(all, apart, 160).psnr).toBeGreaterThan(33);
	const near: Wanted = { places: [[0, 0, 0, 1]], eye: [0, 1, 3], levels: [24], size: 160 };
	const [before, after] = [await draw(page, bunny, near), await draw(page, bunny, { ...near, far: 'fewer' })];
	expect(after.triangles).toBe(before.triangles);
	expect(compare(before, after).worst).toBe(0);
});

test('all bodies cast the shadow of fewer faces, and it looks alike', async ({ page }) => {
	const wanted: Wanted = { places: [[0, 0, 0, 1]], eye: [0, 2, 6], size: 240, shadow: true, shorn: true };
	const [all, fewer] = [await draw(page, bunny, wanted), await draw(page, bunny, { ...wanted, far: 'fewer' })];
	expect(all.levels[0]?.[0]).toBeGreaterThan(12);
	expect(all.triangles - fewer.triangles).toBeGreaterThan(6000);
	const { brighter, psnr } = alike(all, fewer, 240);
	test.info().annotations.push({ type: 'alike', description: `${psnr.toFixed(1)} dB, light ${brighter.toFixed(4)}` });
	expect(Math.abs(brighter - 1)).toBeLessThan(0.002);
	expect(psnr).toBeGreaterThan(50);
});

test('where fur has become shorter, far bodies have more faces again', async ({ page }) => {
	await page.evaluate(() => loaded.blind());
	const wanted: Wanted = { places: [[0, 0, 0, 1]], eye: [0, 2, 20], levels: [12], far: 'fewer' };
	const faces = async (shorter: number) => (await draw(page, bunny, { ...wanted, shorter })).triangles;
	const [whole, little, much] = [await faces(1), await faces(0.8), await faces(0.3)];
	expect(little).toBe(whole);
	expect(much).toBeGreaterThan(1.2 * whole);
});

test('only what moves is uploaded', async ({ page }) => {
	await page.evaluate(() => loaded.blind());
	const uploads = await page.evaluate(([url, places]) => loaded.frames(url, { places }), [sphere, crowd] as const);
	for (const name of ['first', 'camera', 'body', 'fewer']) expect(uploads[name], name).toBeGreaterThan(0);
	for (const name of ['still', 'lamp', 'still again', 'at last']) expect(uploads[name], name).toBe(0);
});

test('bodies share the fur on the GPU, and leave it as it was', async ({ page }) => {
	const { counts, pictures } = await page.evaluate(
		([url, places]) => loaded.memory(url, { places, shadow: true, levels: [24, 12], far: 'fewer' }),
		[bunny, crowd] as const,
	);
	const [before, during, after] = counts;
	expect(during?.planes, 'planes are not uploaded twice').toBe(before?.planes);
	expect(during?.buffers).toBeGreaterThan(before?.buffers ?? Number.NaN);
	expect(after?.geometries).toBe(before?.geometries);
	expect(after?.buffers).toBe(before?.buffers);
	expect(pictures.map((picture) => picture === pictures[0])).toEqual([true, true, true]);
});
