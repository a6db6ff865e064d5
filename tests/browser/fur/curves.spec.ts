/** Mean curves in the shaders: under lamps above and below the horizon as numpy has it, under a sky as under lamps all around. */

import { readFile } from 'node:fs/promises';
import { expect, test } from '../harness.ts';
import type { Stage } from '../inPage/stage.ts';
import { floats, openStage, readFloats, repository, served } from '../library.ts';

declare const stage: Stage;

const golden = 'tests/golden/ptm-6-curves';
const json = async (file: string) => JSON.parse(await readFile(`${repository}${golden}/${file}`, 'utf8'));

/** Curvature of a ball of this radius, in lengths of fur of half a unit. */
const ball = (radius: number) => [1 / (0.5 * radius), 1 / (0.5 * radius), 0];

test("the shader's L equals numpy's on bodies of every radius", async ({ page }) => {
	await openStage(page);
	const { bodies, lights }: { bodies: number[]; lights: number[][] } = await json('lights.json');
	const expected = await readFloats(`${golden}/light.f32`);
	const count = expected.length / bodies.length;
	let worst = 0;
	for (const [b, radius] of bodies.entries()) {
		const light = floats(
			await page.evaluate(([url, l, a]) => stage.light(url, l, a), [
				served(`${golden}/model.gltf`),
				lights,
				{ curvature: ball(radius) },
			] as const),
		);
		expect(light).toHaveLength(count);
		light.forEach((value, i) => {
			worst = Math.max(worst, Math.abs(value - (expected[b * count + i] ?? Number.NaN)));
		});
	}
	test.info().annotations.push({ type: 'largest error', description: worst.toExponential(2) });
	expect(worst).toBeLessThan(4e-3);
	expect(Math.max(...expected)).toBeGreaterThan(2);
});

test('contrast spreads texels around what they have in common, the mean curve', async ({ page }) => {
	await openStage(page);
	const { bodies, lights }: { bodies: number[]; lights: number[][] } = await json('lights.json');
	const stored = await readFloats(`${golden}/light.f32`);
	const [each, none, twice] = await Promise.all(
		[1, 0, 2].map(async (contrast) =>
			floats(
				await page.evaluate(([url, l, a, c]) => stage.light(url, l, a, c), [
					served(`${golden}/model.gltf`),
					lights,
					{ curvature: ball(bodies[0] as number) },
					contrast,
				] as const),
			),
		),
	);
	if (!each || !none || !twice) throw new Error('nothing drawn');
	const texels = 64;
	let spread = 0;
	each.forEach((light, i) => {
		expect(Math.abs(light - (stored[i] ?? Number.NaN))).toBeLessThan(4e-3);
		const mean = none[i] as number;
		// One light for the whole slab.
		expect(Math.abs(mean - (none[texels * Math.floor(i / texels)] as number))).toBeLessThan(4e-3);
		if (light > 0.01 && mean > 0) expect(twice[i]).toBeCloseTo(Math.max(2 * light - mean, 0), 1);
		spread = Math.max(spread, Math.abs(light - mean));
	});
	expect(spread).toBeGreaterThan(0.5);
});

test("lamps go by the skin's curvature along their azimuth, and by the hair's length", async ({ page }) => {
	await openStage(page);
	const light = [0.4, -0.9, -0.17];
	const draw = (curvature: number[], to = light, length = 1) =>
		page.evaluate(([url, a, lamp]) => stage.vertices(url, 3, a, { lamp }), [
			served(`${golden}/model.gltf`),
			{ curvature, _fur: [1, length, 1, 0] } as Record<string, number[]>,
			to,
		] as const);
	const close = (of: number[]) => of.map((value) => expect.closeTo(value, 3));
	// Half of it at every azimuth, and at 45° to both axes in the mixed one.
	const [u = 0, v = 0] = light;
	const level = u * u + v * v;
	const along = 0.5 * ((u * u) / level) + 2 * ((v * v) / level) + (2 * 0.3 * u * v) / level;
	const ridge = await draw([0.5, 2, 0.3]);
	expect(ridge.light).toEqual(close((await draw([along, along, 0])).light));
	expect(ridge.light).not.toEqual(close((await draw([0.5, 0.5, 0])).light));
	// A hair half as long stands on a body of twice the radius; what is hollow is flat.
	expect((await draw([1, 1, 0], light, 0.5)).light).toEqual(close((await draw([0.5, 0.5, 0])).light));
	expect((await draw([-3, -3, 0])).light).toEqual(close((await draw([0.1, 0.1, 0])).light));
	expect((await draw([2, 0, 0], [0, 0, 1])).light).toEqual(close((await draw([1, 1, 0], [0, 0, 1])).light));
});

test('bent hairs have the curve of the direction that they are lit from', async ({ page }) => {
	await openStage(page);
	const { bends, lights }: { bends: number[][]; lights: number[][] } = await json('bent.json');
	const expected = await readFloats(`${golden}/bent.f32`);
	let [compared, worst] = [0, 0];
	for (const [b, radius] of [
		[0, 1],
		[2, 7],
	] as const)
		for (const [n, lamp] of lights.entries())
			for (const [i, right, up] of [
				[0, 1, 0],
				[2, -1, 1],
			] as const) {
				const drawn = await page.evaluate(([url, a, l]) => stage.vertices(url, 3, a, { lamp: l }), [
					served(`${golden}/model.gltf`),
					{ _comb: bends[i] ?? [], curvature: ball(radius) },
					lamp,
				] as const);
				const first = ((b * lights.length + n) * bends.length + i) * 64;
				drawn.light.forEach((light, texel) => {
					const [column, row] = [(texel % 8) - right, Math.floor(texel / 8) - up];
					if (column < 0 || column > 7 || row < 0 || row > 7) return;
					compared++;
					worst = Math.max(worst, Math.abs(light - (expected[first + row * 8 + column] ?? Number.NaN)));
				});
			}
	expect(compared).toBeGreaterThan(8 * 45);
	expect(worst).toBeLessThan(4e-3);
	expect(Math.max(...expected)).toBeGreaterThan(1);
});

test("a fin's L is that of its height", async ({ page }) => {
	await openStage(page);
	const { bodies, lights }: { bodies: number[]; lights: number[][] } = await json('lights.json');
	const expected = await readFloats(`${golden}/fin.f32`);
	const count = expected.length / bodies.length;
	let worst = 0;
	for (const [b, radius] of bodies.entries()) {
		const world = lights.map(([t, w, n]) => [t ?? 0, n ?? 0, w ?? 0]);
		const light = floats(
			await page.evaluate(([url, l, c]) => stage.heights(url, l, c), [
				served(`${golden}/model.gltf`),
				world,
				ball(radius),
			] as const),
		);
		expect(light).toHaveLength(count);
		light.forEach((value, i) => {
			worst = Math.max(worst, Math.abs(value - (expected[b * count + i] ?? Number.NaN)));
		});
	}
	expect(worst).toBeLessThan(4e-3);
});

test('the sky lights fur, bent or not, as lamps all around do', async ({ page }) => {
	await openStage(page);
	const combs = [
		[0, 0],
		[0.4, 0],
		[-0.3, 0.4],
	];
	const harmonics = [1.2, 0.3, -0.3, 0.35, 0.15, -0.1, 0.12, 0.18, -0.14];
	const drawn = await page.evaluate(([url, c, h, r]) => stage.dome(url, 2, c, h, r), [
		served(`${golden}/model.gltf`),
		combs,
		harmonics,
		4,
	] as const);
	for (const [i, { sky, lamps }] of drawn.entries()) {
		const seen = sky.flatMap((light, at) => (Number.isNaN(light) ? [] : [[light, lamps[at] ?? Number.NaN] as const]));
		expect(seen.length).toBeGreaterThan(20);
		const brightest = Math.max(...seen.map(([, truth]) => truth));
		const squares = seen.reduce((sum, [light, truth]) => sum + (light - truth) ** 2, 0);
		const error = Math.sqrt(squares / seen.length) / brightest;
		test.info().annotations.push({ type: `error at ${combs[i]}`, description: error.toFixed(4) });
		expect(error).toBeLessThan(i === 0 ? 0.005 : 0.03);
	}
});

test('lamps per fragment are as lamps per vertex', async ({ page }) => {
	await openStage(page);
	const [vertex, fragment] = await page.evaluate(([url]) => stage.bothWays(url), [
		served(`${golden}/model.gltf`),
	] as const);
	expect(Math.max(...(vertex ?? []))).toBeGreaterThan(0.5);
	expect(fragment).toEqual(vertex?.map((value) => expect.closeTo(value, 3)));
});
