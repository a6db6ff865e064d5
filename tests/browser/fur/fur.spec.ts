/** The library on the GPU: what is uploaded, what the shader makes of it, what it refuses. */

import { readFile } from 'node:fs/promises';
import { decode } from 'fast-png';
import type { FurAsset } from '../../../web/fur/format.ts';
import { lightMoments } from '../../../web/fur/light/moments.ts';
import { expect, test } from '../harness.ts';
import type { Stage } from '../inPage/stage.ts';
import { floats, openStage, readAsset, readFloats, repository, served } from '../library.ts';

declare const stage: Stage;

const GOLDEN = ['ptm-6', 'eigen-6', 'eigen-3'];

for (const model of ['public/models/bunny', 'public/models/torus', 'tests/golden/eigen-3']) {
	test(`every byte of ${model}'s planes is on the GPU`, async ({ page }) => {
		await openStage(page);
		const planes = await page.evaluate((url) => stage.planes(url), served(`${model}/model.gltf`));
		const { fur, images } = await readAsset(model);
		const stored = fur.pelts[0]?.planes ?? [];
		expect(planes).toHaveLength(stored.length);
		for (const [i, image] of stored.entries()) {
			const png = decode(await readFile(`${repository}${model}/${images[image]?.uri}`));
			expect(png.channels).toBe(4);
			const gpu = Buffer.from(planes[i] ?? '', 'base64');
			expect(Buffer.compare(gpu, Buffer.from(png.data.buffer, png.data.byteOffset, png.data.byteLength))).toBe(0);
			const covered = i === stored.length - 1 ? (stored.length === 2 ? 2 : 3) : undefined;
			if (covered !== undefined && model.startsWith('public')) {
				const empty = gpu.filter((byte, b) => b % 4 === covered && byte === 0).length;
				expect(empty, 'texels with α = 0 are among them').toBeGreaterThan(100);
			}
		}
	});
}

test('directions are on the GPU byte for byte, linear, and are freed', async ({ page }) => {
	await openStage(page);
	for (const model of ['public/models/torus-512-colour', 'public/models/torus-512-eigen3']) {
		const got = await page.evaluate((url) => stage.directions(url), served(`${model}/model.gltf`));
		const { fur, images } = await readAsset(model);
		const png = decode(await readFile(`${repository}${model}/${images[fur.pelts[0]?.direction ?? -1]?.uri}`));
		expect(png.channels).toBe(3);
		const gpu = Buffer.from(got.bytes, 'base64').filter((_, i) => i % 4 < 3);
		expect(Buffer.compare(gpu, Buffer.from(png.data.buffer, png.data.byteOffset, png.data.byteLength))).toBe(0);
		expect([got.colorSpace, got.levels, got.left]).toEqual(['', Math.log2(fur.size) + 1, 0]);
	}
});

for (const name of GOLDEN) {
	test(`the shader's L equals numpy's: ${name}`, async ({ page }) => {
		await openStage(page);
		const folder = `tests/golden/${name}`;
		const lights: number[][] = JSON.parse(await readFile(`${repository}${folder}/lights.json`, 'utf8'));
		const expected = await readFloats(`${folder}/light.f32`);
		const light = floats(
			await page.evaluate(([url, l]) => stage.light(url, l), [served(`${folder}/model.gltf`), lights] as const),
		);
		expect(light).toHaveLength(expected.length);
		let worst = 0;
		light.forEach((value, i) => {
			worst = Math.max(worst, Math.abs(value - (expected[i] ?? Number.NaN)));
		});
		test.info().annotations.push({ type: 'largest error', description: worst.toExponential(2) });
		expect(worst).toBeLessThanOrEqual(1e-3);
	});

	test(`an environment of order 2 equals its integral: ${name}`, async ({ page }) => {
		await openStage(page);
		const folder = `tests/golden/${name}`;
		const { fur, images } = await readAsset(folder);
		const probe = [1.2, 0.2, -0.3, 0.25, 0.15, -0.1, 0.12, 0.18, -0.14];
		const ambient = 0.7;
		const dome = { sky: 1.5, ground: 0.4, up: [0.36, 0.48, 0.8] };
		const { light, frame } = await page.evaluate(([url, p, a, d]) => stage.environment(url, p, a, d), [
			served(`${folder}/model.gltf`),
			probe,
			ambient,
			dome,
		] as const);
		const radiance = (x: number[]) =>
			worldRadiance(x, probe) +
			(ambient + (dome.sky + dome.ground) / 2) / Math.PI +
			((0.75 * (dome.sky - dome.ground)) / Math.PI) * dot(x, dome.up);
		const moments = integrate(fur, frame, radiance, 0.5 / fur.layers);
		const coefficients = await layerCoefficients(folder, fur, images);
		light.forEach((value, i) => {
			const exact = Math.max(dot(coefficients[i] ?? [], moments), 0);
			expect(Math.abs(value - exact)).toBeLessThan(2e-3 * Math.max(1, exact));
		});
		expect(Math.max(...light)).toBeGreaterThan(1);
	});
}

test('another basis costs one program at most, and none the second time', async ({ page }) => {
	await openStage(page);
	const order = ['ptm-6', 'eigen-6', 'ptm-6', 'eigen-6'].map((name) => served(`tests/golden/${name}/model.gltf`));
	const [first = 0, ...others] = await page.evaluate((urls) => stage.programs(urls), order);
	expect(first).toBeGreaterThan(0);
	expect(others).toEqual([first + 1, first + 1, first + 1]);
});

for (const [what, change, message] of [
	['planes of another size', { size: 16 }, 'plane0.png: got 8 × 32 pixels, expected 16 × 64'],
	['a node that is no mesh', { shells: 7 }, 'FUR_ptm_shells/shells: node 7 is no mesh with one primitive'],
	['a layer count out of range', { layers: -1 }, 'FUR_ptm_shells/layers:'],
] as const) {
	test(`${what}: refused in one sentence`, async ({ page }) => {
		await openStage(page);
		const path = 'tests/golden/ptm-6/model.gltf';
		const gltf = JSON.parse(await readFile(`${repository}${path}`, 'utf8'));
		Object.assign(gltf.extensions.FUR_ptm_shells, change);
		await page.route('**/ptm-6/model.gltf', (route) => route.fulfill({ json: gltf }));
		const said = await page.evaluate((url) => stage.refusal(url), served(path));
		expect(said).toContain(message);
		expect(said).not.toContain('\n');
	});
}

test('a skin of several materials is one body', async ({ page }) => {
	await openStage(page);
	const path = 'tests/golden/eigen-3/model.gltf';
	const gltf = JSON.parse(await readFile(`${repository}${path}`, 'utf8'));
	gltf.materials.push({ name: 'other', pbrMetallicRoughness: { baseColorFactor: [1, 0, 0, 1] } });
	gltf.meshes[0].primitives.push({ ...gltf.meshes[0].primitives[0], material: 1 });
	await page.route('**/eigen-3/model.gltf', (route) => route.fulfill({ json: gltf }));
	expect(await page.evaluate((url) => stage.refusal(url), served(path))).toBe('loaded');
});

test('of a newer version the skin alone is shown, with a warning', async ({ page, watch }) => {
	await openStage(page);
	const path = 'tests/golden/ptm-6/model.gltf';
	const gltf = JSON.parse(await readFile(`${repository}${path}`, 'utf8'));
	gltf.extensions.FUR_ptm_shells = { version: '9.0', whatever: [] };
	await page.route('**/ptm-6/model.gltf', (route) => route.fulfill({ json: gltf }));
	expect(await page.evaluate((url) => stage.refusal(url), served(path))).toBe('loaded');
	expect(watch.complaints.splice(0)).toEqual(['FUR_ptm_shells: version 9.0 is newer than 2.3; showing the skin alone']);
});

const dot = (a: readonly number[], b: readonly number[]) => a.reduce((sum, x, i) => sum + x * (b[i] ?? 0), 0);

/** Σ_j probe[j]·Y_j of a unit vector in world axes. */
function worldRadiance([x = 0, y = 0, z = 0]: number[], probe: number[]): number {
	const { PI, sqrt } = Math;
	const harmonics = [
		sqrt(1 / (4 * PI)),
		...[y, z, x].map((axis) => sqrt(3 / (4 * PI)) * axis),
		sqrt(15 / (4 * PI)) * x * y,
		sqrt(15 / (4 * PI)) * y * z,
		sqrt(5 / (16 * PI)) * (3 * z * z - 1),
		sqrt(15 / (4 * PI)) * x * z,
		sqrt(15 / (16 * PI)) * (x * x - y * y),
	];
	return dot(harmonics, probe);
}

/** ∫R(ω)·φ(ω)dω by brute force: as many lamps, those below the horizon fading as lamps do at this height. */
function integrate(fur: FurAsset, frame: number[][], radiance: (world: number[]) => number, s: number): number[] {
	const rings = 2000;
	const spokes = 64;
	const moments = new Array<number>(fur.coefficients).fill(0);
	for (let r = 0; r < rings; r++) {
		const z = (2 * r + 1) / rings - 1;
		for (let spoke = 0; spoke < spokes; spoke++) {
			const azimuth = ((spoke + 0.5) / spokes) * 2 * Math.PI;
			const local: [number, number, number] = [
				Math.sqrt(1 - z * z) * Math.cos(azimuth),
				Math.sqrt(1 - z * z) * Math.sin(azimuth),
				z,
			];
			const world = [0, 1, 2].map((axis) => local.reduce((sum, c, i) => sum + c * (frame[i]?.[axis] ?? 0), 0));
			const weight = (radiance(world) * 4 * Math.PI) / (rings * spokes);
			lightMoments(fur.basis, local, s).forEach((phi, i) => {
				moments[i] = (moments[i] ?? 0) + weight * phi;
			});
		}
	}
	return moments;
}

/** Coefficients of layer 0, texel by texel. */
async function layerCoefficients(folder: string, fur: FurAsset, images: { uri: string }[]): Promise<number[][]> {
	const pelt = fur.pelts[0];
	const planes = await Promise.all(
		(pelt?.planes ?? []).map(async (i) => decode(await readFile(`${repository}${folder}/${images[i]?.uri}`)).data),
	);
	const slots = [
		[0, 0],
		[0, 1],
		[0, 2],
		[1, 0],
		[1, 1],
		[0, 3],
	].slice(0, fur.coefficients);
	return Array.from({ length: fur.size * fur.size }, (_, texel) =>
		slots.map(([plane = 0, channel = 0], i) => {
			const byte = planes[plane]?.[texel * 4 + channel] ?? Number.NaN;
			return (pelt?.scale[i] ?? 0) * (byte - (pelt?.bias[i] ?? 0));
		}),
	);
}
