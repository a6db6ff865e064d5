/** Fins on the GPU: their light, where they are, what the packed attributes do. */

import { readFile } from 'node:fs/promises';
import type { Page } from '@playwright/test';
import { type Direction, lightMoments } from '../../../web/fur/light/moments.ts';
import { expect, test } from '../harness.ts';
import type { Stage } from '../inPage/stage.ts';
import { floats, openStage, readFloats, repository, served } from '../library.ts';

declare const stage: Stage;

const golden = 'tests/golden/ptm-6';
const ptm = { kind: 'ptm' } as const;

/**
 * The golden asset with fins, but only one: a quad along x at z = 0.
 *
 * @param laid angle to where the fur is laid, turns; undefined: no attribute tells
 */
async function withOneFin(laid?: number) {
	const gltf = JSON.parse(await readFile(`${repository}${golden}/model.gltf`, 'utf8'));
	const fur = gltf.extensions.FUR_ptm_shells;
	const vertices = [
		{ POSITION: [-0.5, -1, 0], at: [0, 0] },
		{ POSITION: [0.5, -1, 0], at: [1, 0] },
		{ POSITION: [-0.5, -1, 0], at: [0, 1] },
		{ POSITION: [0.5, -1, 0], at: [1, 1] },
	].map(({ POSITION, at }) => ({
		POSITION,
		TEXCOORD_0: at.map((tile) => tile / fur.tiles),
		NORMAL: [0, 1, 0],
		TANGENT: [1, 0, 0, 1],
		_EDGE: [0.5, -0.5, 0, 0],
		_FUR: laid === undefined ? [] : [laid, 1, 1, 0],
	}));
	const attributes: Record<string, number> = {};
	for (const name of ['POSITION', 'TEXCOORD_0', 'NORMAL', 'TANGENT', '_EDGE', '_FUR'] as const) {
		if (!vertices[0]?.[name].length) continue;
		const values = Buffer.from(new Float32Array(vertices.flatMap((vertex) => vertex[name])).buffer);
		const width = vertices[0]?.[name].length;
		const bounds = name === 'POSITION' ? { min: [-0.5, -1, 0], max: [0.5, -1, 0] } : {};
		attributes[name] = gltf.accessors.length;
		gltf.accessors.push({
			bufferView: gltf.bufferViews.length,
			componentType: 5126,
			count: 4,
			type: `VEC${width}`,
			...bounds,
		});
		gltf.bufferViews.push({ buffer: gltf.buffers.length, byteLength: values.length });
		gltf.buffers.push({
			byteLength: values.length,
			uri: `data:application/octet-stream;base64,${values.toString('base64')}`,
		});
	}
	const corners = Buffer.from(new Uint16Array([0, 1, 3, 0, 3, 2]).buffer);
	const indices = gltf.accessors.length;
	gltf.accessors.push({ bufferView: gltf.bufferViews.length, componentType: 5123, count: 6, type: 'SCALAR' });
	gltf.bufferViews.push({ buffer: gltf.buffers.length, byteLength: corners.length });
	gltf.buffers.push({ byteLength: 12, uri: `data:application/octet-stream;base64,${corners.toString('base64')}` });
	fur.fins = gltf.nodes.length;
	// Elsewhere than the shells' node: its own transform brings the quad to the origin.
	gltf.nodes.push({ name: 'fin', mesh: gltf.meshes.length, translation: [0, 1, 0] });
	gltf.meshes.push({ primitives: [{ attributes, indices }] });
	return gltf;
}

for (const laid of [undefined, 0.3]) {
	test(`a fin's L equals numpy's in the frame of fur ${laid ? 'across' : 'along'} the edge, below the horizon too`, async ({
		page,
	}) => {
		await openStage(page);
		const gltf = await withOneFin(laid);
		await page.route('**/ptm-6/model.gltf', (route) => route.fulfill({ json: gltf }));
		const lights: [number, number, number][] = JSON.parse(await readFile(`${repository}${golden}/lights.json`, 'utf8'));
		const expected = await readFloats(`${golden}/fin.f32`);
		const { width, height } = gltf.extensions.FUR_ptm_shells.pelts[0].fin;
		// (l·t, l·w, l·n) to world axes: n is y, t is x where the fur is laid along the edge.
		const [cos, sin] = [Math.cos(2 * Math.PI * (laid ?? 0)), Math.sin(2 * Math.PI * (laid ?? 0))];
		const world = lights.map(([t, w, n]) => [cos * t - sin * w, n, sin * t + cos * w]);
		const fin = await page.evaluate(([url, l]) => stage.fin(url, l), [served(`${golden}/model.gltf`), world] as const);
		const light = floats(fin.light);
		expect(light).toHaveLength(expected.length);
		const fade = ([t, w, n]: Direction, s: number) => lightMoments(ptm, [t, w, n], s)[5] ?? Number.NaN;
		let worst = 0;
		let below = 0;
		light.forEach((value, i) => {
			const direction = lights[Math.floor(i / (width * height))] ?? [0, 0, 1];
			const s = ((Math.floor(i / width) % height) + 0.5) / height;
			let wanted = expected[i] ?? Number.NaN;
			if (direction[2] < 0) {
				// Between root and tip the quad's light is linear; at the root nothing comes from below.
				const exact = fade(direction, s);
				if (exact === 0 && fade(direction, 1) > 0) return;
				wanted *= exact ? (s * fade(direction, 1)) / exact : 1;
				below++;
			}
			worst = Math.max(worst, Math.abs(value - wanted));
		});
		expect(worst).toBeLessThan(2e-3);
		expect(below).toBeGreaterThan(8 * width * height);
		const alphas = Array.from({ length: height }, (_, row) => floats(fin.alpha)[row * width] ?? Number.NaN);
		expect(alphas).toEqual(alphas.map((_, row) => expect.closeTo((0.9 * (255 - 32 * row)) / 255, 4)));
	});
}

test('a vertex brings weight, openness, tip and colour', async ({ page }) => {
	await openStage(page);
	const draw = (attributes: Record<string, number[]>, light: Parameters<Stage['vertices']>[3]) =>
		page.evaluate(([url, a, l]) => stage.vertices(url, 3, a, l), [
			served(`${golden}/model.gltf`),
			attributes,
			light,
		] as const);
	const times = (light: number[], factor: number) => light.map((value) => expect.closeTo(factor * value, 3));
	const lamp = [0.48, 0.6, 0.64];
	const plain = await draw({}, { lamp, ambient: 1 });
	const lampOnly = await draw({}, { lamp });

	const half = await draw({ _fur: [0.5, 1, 1, 0] }, { lamp, ambient: 1 });
	expect(half.alpha).toEqual(plain.alpha.map((alpha) => expect.closeTo(1 - Math.sqrt(1 - alpha), 3)));
	expect(half.light).toEqual(times(plain.light, 1));

	const hollow = await draw({ _fur: [1, 1, 0.25, 0] }, { lamp, ambient: 1 });
	const sky = plain.light.map((light, i) => light - (lampOnly.light[i] ?? Number.NaN));
	hollow.light.forEach((light, i) => {
		expect(light - (lampOnly.light[i] ?? Number.NaN)).toBeCloseTo(0.25 * (sky[i] ?? Number.NaN), 3);
	});

	// s = 7/8 of a ramp of power 1, from white to the middle of white and a quarter
	const tipped = await draw({ _fur: [1, 1, 1, 0.5] }, { lamp, ambient: 1, tip2: [0.25, 0.25, 0.25] });
	expect(tipped.light).toEqual(times(plain.light, 1 - 0.375 * 0.875));

	const coloured = await draw({ color: [0.5, 0.1, 0.1] }, { lamp, ambient: 1 });
	expect(coloured.light).toEqual(times(plain.light, 0.5));
});

/** A drawing of the sphere: premultiplied rgba, and how far each pixel is from the centre. */
interface Drawing {
	rgba: Float32Array;
	/** model units, per pixel */
	away: number[];
	/** left of the centre, from where the lamp shines */
	left: boolean[];
}

async function drawSphere(page: Page, wanted: { shells: number; fins: boolean; azimuth?: number }[], size = 240) {
	const { pictures, orders, scale, ...model } = await page.evaluate(([url, n, w]) => stage.drawings(url, n, w), [
		served('public/models/sphere/model.gltf'),
		size,
		wanted,
	] as const);
	const across = Array.from({ length: size }, (_, i) => (i + 0.5 - size / 2) / scale);
	const away = across.flatMap((y) => across.map((x) => Math.hypot(x, y)));
	const left = across.flatMap(() => across.map((x) => x < 0));
	const drawings = pictures.map((picture): Drawing => ({ rgba: floats(picture), away, left }));
	return { drawings, orders, ...model };
}

const covered = ({ rgba }: Drawing, i: number) => rgba[i * 4 + 3] ?? 0;

test('fins fill the outline, change nothing but it, and are as bright as the shells beside them', async ({ page }) => {
	await openStage(page);
	const { drawings, radius, length } = await drawSphere(page, [
		{ shells: 64, fins: false },
		{ shells: 16, fins: false },
		{ shells: 16, fins: true },
		{ shells: 16, fins: false },
	]);
	const [ideal, without, fins, again] = drawings as [Drawing, Drawing, Drawing, Drawing];
	expect(again.rgba, 'what fins leave behind when they go').toEqual(without.rgba);

	/** Of what more shells than anybody draws cover beside the skin. */
	const share = (drawing: Drawing) => {
		const wanted = ideal.away.flatMap((r, i) => (r > 1.02 * radius && covered(ideal, i) >= 0.5 ? [i] : []));
		return wanted.filter((i) => covered(drawing, i) >= 0.5).length / wanted.length;
	};
	const note = (description: string) => test.info().annotations.push({ type: 'outline', description });
	note(`${(100 * share(without)).toFixed(2)} % without fins, ${(100 * share(fins)).toFixed(2)} % with them`);
	expect(share(fins)).toBeGreaterThan(share(without));
	expect(share(fins)).toBeGreaterThan(0.95);

	// Where the sphere is steep enough for fins to begin, and how far their tips may stand out.
	const changed = fins.away.filter((_, i) => Math.abs(covered(fins, i) - covered(without, i)) > 0.01);
	expect(changed.length).toBeGreaterThan(100);
	expect(Math.min(...changed)).toBeGreaterThan(0.8 * radius);
	expect(Math.max(...changed)).toBeLessThan(radius + 1.25 * length);
	const inside = fins.rgba.filter((value, i) => {
		return (fins.away[i >> 2] ?? 0) < 0.8 * radius && value !== without.rgba[i];
	});
	expect(inside).toHaveLength(0);

	for (const side of [true, false]) {
		/** Mean brightness of what covers a ring, uncovered pixels not counted. */
		const brightness = (drawing: Drawing, from: number, to: number) => {
			let [light, weight] = [0, 0];
			drawing.away.forEach((r, i) => {
				if (drawing.left[i] !== side || r < from || r > to) return;
				light += drawing.rgba[i * 4] ?? 0;
				weight += covered(drawing, i);
			});
			return light / weight;
		};
		const ring = [radius, radius + length] as const;
		const ratio = brightness(fins, ...ring) / brightness(ideal, ...ring);
		note(`${side ? 'lit' : 'dark'} side: ${ratio.toFixed(2)} as bright as 64 shells`);
		expect(ratio).toBeGreaterThan(0.85);
		expect(ratio).toBeLessThan(1.18);
	}
});

test('fins are drawn before the shells from every side', async ({ page }) => {
	await openStage(page);
	const sides = [0, 1, 2, 3, 4, 5].map((azimuth) => ({ shells: 1, fins: true, azimuth }));
	const { orders } = await drawSphere(page, sides, 16);
	for (const order of orders) expect(order).toEqual(['fins', 'fur']);
});

test('fins are measured: what they add to the outline, where they are, what a frame takes', async ({ page }) => {
	await openStage(page);
	const figures = await page.evaluate(([url, o]) => stage.fins(url, o), [
		served('public/models/sphere/model.gltf'),
		{ width: 180, height: 120, counts: [2], rounds: 1 },
	] as const);
	expect(figures.views.map(({ name }) => name)).toEqual(['front', 'side', 'above']);
	for (const { beside, all, extra, finPixels, outside } of figures.views) {
		// A ring of fur around a disc of skin, whose radius is 48 pixels.
		const ring = Math.PI * ((48 + figures.length) ** 2 - 48 ** 2);
		expect(beside.pixels).toBeGreaterThan(0.3 * ring);
		expect(beside.pixels).toBeLessThan(1.1 * ring);
		expect(beside.fins).toBeGreaterThanOrEqual(beside.without);
		expect(beside.fins).toBeLessThanOrEqual(beside.pixels);
		expect(Math.abs(all.pixels - beside.pixels - Math.PI * 48 ** 2)).toBeLessThan(0.02 * all.pixels);
		// The whole skin is covered, with fins and without.
		expect(all.without - beside.without).toBe(all.pixels - beside.pixels);
		expect(all.fins - beside.fins).toBe(all.pixels - beside.pixels);
		expect(extra.pixels).toBe(180 * 120 - all.pixels);
		expect(extra.fins).toBeLessThan(0.5 * ring);
		expect(finPixels).toBeGreaterThan(0.5 * ring);
		expect(outside).toBeLessThan(0.01 * finPixels);
	}
	const [cost] = figures.costs;
	expect(cost?.shells).toBe(2);
	for (const value of [cost?.without, cost?.fins, cost?.ratio]) expect(value).toBeGreaterThan(0);
});

for (const parallel of [false, true])
	test(`fins that ${parallel ? 'parallel rays' : 'an eye'} cannot meet are left out, and no pixel changes`, async ({
		page,
	}) => {
		await openStage(page);
		const sides: [number, number, number][] = [
			[0, 0.5, 5],
			[4, 2, 1],
			[-3, 4, -2],
			[0.1, -4, 1],
		];
		const figures = await page.evaluate(([url, from, flat]) => stage.chosen(url, from, flat), [
			// Nothing moves it: of a body with joints all fins are drawn.
			'/models/tiger/model.gltf',
			sides,
			parallel,
		] as const);
		for (const [few = 0, all = 0, different, seen] of figures) {
			expect(few).toBeLessThan(0.5 * all);
			expect(seen).toBeGreaterThan(1000);
			expect(different).toBe(0);
		}
	});
