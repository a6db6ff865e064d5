/** Characters: fur on bodies that are moved by joints and morph targets. */

import { character, type Made } from '../character.ts';
import { expect, test } from '../harness.ts';
import { floats, openInPage, served } from '../library.ts';
import { PosedGltf } from '../posed.ts';

declare const loaded: typeof import('../inPage/pose.ts');

const torus = served('public/models/torus-512/model.gltf');
const bunny = served('public/models/bunny/model.gltf');

test.beforeEach(({ page }) => openInPage(page, 'pose'));

/** Largest distance between places that should be the same, and from the middle of `bounds`. */
function compare(got: Float32Array, wanted: (vertex: number) => ArrayLike<number>, bounds: { center: number[] }) {
	let [worst, far] = [0, 0];
	for (let v = 0; v < got.length / 3; v++) {
		const [x, y, z] = wanted(v) as unknown as [number, number, number];
		const [gx, gy, gz] = got.subarray(3 * v, 3 * v + 3) as unknown as [number, number, number];
		worst = Math.max(worst, Math.hypot(gx - x, gy - y, gz - z));
		const [cx = 0, cy = 0, cz = 0] = bounds.center;
		far = Math.max(far, Math.hypot(x - cx, y - cy, z - cz));
	}
	return { worst, far };
}

test('roots on the GPU are where joints and morph targets put them, within the bounds', async ({ page }) => {
	const { json, buffers } = await character();
	await page.route('**/torus-512/model.gltf', (route) => route.fulfill({ json }));
	const moments = [undefined, 0, 0.2, 0.45, 0.7, 0.99].map((seconds) =>
		seconds === undefined ? [undefined, 0] : ['Wave', seconds],
	) as [string | undefined, number][];
	const { answers, error } = await page.evaluate(([url, at]) => loaded.vertices(url, at), [torus, moments] as const);
	const { shells, fins } = json.extensions.FUR_ptm_shells;
	const still = new PosedGltf(json, buffers).vertices(shells);
	const size = Math.max(...still) - Math.min(...still);
	let moved = 0;
	for (const [i, [clip, seconds]] of moments.entries()) {
		const answer = answers[i];
		if (!answer?.fins) throw new Error('no answer');
		const posed = new PosedGltf(json, buffers, clip, seconds);
		const weights = posed.weights(0);
		const wanted = posed.vertices(shells, weights);
		const roots = compare(floats(answer.shells), (v) => wanted.subarray(3 * v, 3 * v + 3), answer);
		expect(roots.worst / size, `shells at ${seconds} s`).toBeLessThan(1e-4);
		expect(roots.far, 'bounds of shells').toBeLessThan(answer.radius - 0.5 * answer.length);
		expect(answer.radius, 'bounds that fit').toBeLessThan(2 * roots.far);
		const quads = posed.vertices(fins, weights);
		const rows = (2 * answer.rows) / (quads.length / 12) / 2;
		const atFins = compare(
			floats(answer.fins),
			(v) => {
				const root = 4 * Math.floor(v / (2 * rows)) + (v % 2);
				return quads.subarray(3 * root, 3 * root + 3);
			},
			answer,
		);
		expect(atFins.worst / size, `fins at ${seconds} s`).toBeLessThan(1e-4);
		moved = Math.max(moved, ...wanted.map((value, j) => Math.abs(value - (still[j] ?? 0))));
	}
	expect(moved / size, 'the clip moves it').toBeGreaterThan(0.3);
	expect(error).toBe(0);
});

test('no crack opens between patches of a body that moves', async ({ page }) => {
	const { json } = await character('public/models/bunny');
	await page.route('**/bunny/model.gltf', (route) => route.fulfill({ json: bare(json) }));
	const moments = [0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9].map((seconds) => ['Wave', seconds] as [string, number]);
	const { counts, error } = await page.evaluate(([url, at]) => loaded.cracks(url, at, 400), [bunny, moments] as const);
	for (const { inside, open } of counts) {
		expect(inside).toBeGreaterThan(5000);
		expect(open).toBe(0);
	}
	expect(error).toBe(0);
});

test('of a body that moves only the fins that are seen are drawn, and no hair is missing', async ({ page }) => {
	const moments = [0.2, 0.5, 0.8];
	const { answers, both, left, error } = await page.evaluate(([url, at]) => loaded.seenFins(url, 'hop', at), [
		bunny,
		moments,
	] as const);
	for (const { share, alike, without } of answers) {
		expect(share).toBeGreaterThan(0.1);
		expect(share).toBeLessThan(0.4);
		expect(alike).toBeGreaterThan(90);
		expect(without, 'fins are seen at all').toBeLessThan(60);
	}
	expect({ both, left }, 'indices on the GPU').toEqual({ both: 2, left: 0 });
	expect(error).toBe(0);
});

// The bunny has patches, and no fins here; the ring has fins.
for (const [name, body, shadows] of [
	['bunny', 'public/models/bunny', false],
	['bunny in shadow', 'public/models/bunny', true],
	['ring with fins', 'public/models/torus-512', false],
] as const)
	test(`a body turned by its joint is lit as one turned by its node: ${name}`, async ({ page }) => {
		const { json } = await character(body);
		await page.route('**/moving.gltf', (route) => route.fulfill({ json: bare(json) }));
		const still = structuredClone(json);
		await page.route('**/still.gltf', (route) => route.fulfill({ json: unmoved(bare(still)) }));
		const at = (file: string) => served(`${body}/${file}`);
		const { alike, apart, error } = await page.evaluate(
			([still, moving, shadows]) => loaded.turned(still, moving, shadows),
			[at('still.gltf'), at('moving.gltf'), shadows] as const,
		);
		for (const decibels of alike) expect(decibels).toBeGreaterThan(45);
		expect(apart).toBeLessThan(30);
		expect(error).toBe(0);
	});

/** Without eyes and nose. */
function bare(json: Made['json']): Made['json'] {
	json.scenes[0].nodes = json.scenes[0].nodes.filter(
		(node: number) => node === 0 || json.skins[0].joints.includes(node),
	);
	return json;
}

/** Without what moves it. */
function unmoved(json: Made['json']): Made['json'] {
	json.scenes[0].nodes = [0];
	for (const node of json.nodes) delete node.skin;
	for (const mesh of json.meshes) {
		delete mesh.weights;
		for (const primitive of mesh.primitives) {
			delete primitive.targets;
			for (const name of ['JOINTS_0', 'WEIGHTS_0']) delete primitive.attributes[name];
		}
	}
	delete json.animations;
	return json;
}

test('a copy by SkeletonUtils is a furry character of its own, and both leave nothing behind', async ({ page }) => {
	const { json } = await character();
	await page.route('**/torus-512/model.gltf', (route) => route.fulfill({ json }));
	const seen = await page.evaluate((url) => loaded.twins(url), torus);
	expect(seen.own).toEqual({ skin: true, skeleton: true, material: true, textures: true });
	expect(seen.copied, 'the copy at rest').toBeGreaterThan(60);
	expect(seen.moved, 'the copy in a clip').toBeLessThan(30);
	expect(seen.original, 'the original meanwhile').toBeGreaterThan(60);
	expect(seen.both, 'the original in the same clip').toBeGreaterThan(60);
	expect(seen.left, 'the copy without its original').toBeGreaterThan(60);
	// One texture is three's own, a table for the skin's reflections.
	expect(seen.kept).toEqual({ geometries: 0, textures: 1 });
	expect(seen.error).toBe(0);
});
