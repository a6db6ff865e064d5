/** The law of light on bent hairs in the shaders: under a lamp as numpy has it, under a sky as under lamps all around. */

import { readFile } from 'node:fs/promises';
import { expect, test } from '../harness.ts';
import type { Stage } from '../inPage/stage.ts';
import { openStage, readFloats, repository, served } from '../library.ts';

declare const stage: Stage;

const golden = 'tests/golden/ptm-6';

test('combed hairs move along T and B, lit as numpy says', async ({ page }) => {
	await openStage(page);
	const { bends, light: lamp } = JSON.parse(await readFile(`${repository}${golden}/bent.json`, 'utf8'));
	const expected = await readFloats(`${golden}/bent.f32`);
	const cases = [
		[1, 0, 1],
		[0, 1, 1],
		[-1, 1, 1],
		[1, 0, 0.5], // hairs half as long, combed twice as far
	] as const;
	for (const [i, [right, up, length]] of cases.entries()) {
		const attributes = { _comb: bends[i], _fur: [1, length, 1, 0] };
		const drawn = await page.evaluate(([url, a, l]) => stage.vertices(url, 3, a, { lamp: l }), [
			served(`${golden}/model.gltf`),
			attributes,
			lamp,
		] as const);
		let compared = 0;
		drawn.light.forEach((light, texel) => {
			const [column, row] = [(texel % 8) - right, Math.floor(texel / 8) - up];
			if (column < 0 || column > 7 || row < 0 || row > 7) {
				expect(drawn.alpha[texel]).toBe(0);
				return;
			}
			compared++;
			expect(Math.abs(light - (expected[i * 64 + row * 8 + column] ?? Number.NaN))).toBeLessThan(1e-3);
		});
		expect(compared).toBeGreaterThanOrEqual(49);
	}
	expect(Math.max(...expected)).toBeGreaterThan(1);
});

test('baked numbers of bent hairs meet their terms and powers of the height', async ({ page }) => {
	await openStage(page);
	const { bends, light: lamp } = JSON.parse(await readFile(`${repository}${golden}/bent.json`, 'utf8'));
	const expected = await readFloats(`${golden}/bent.f32`);
	const gltf = JSON.parse(await readFile(`${repository}${golden}/model.gltf`, 'utf8'));
	const [[u, v], [lu, lv, z], s] = [bends[2], lamp, 3.5 / 4];
	// The fur leans by 0.4 along v.
	const [x, q] = [u * lu + v * lv, u * u + v * v];
	const terms = [x * z, v, q * z, q, x, q * lv, q * lv * z, x * lv];
	const general = s * (q * (2.7 * z - 1.5) - 1.8 * x * z) - 0.2 * v;
	// One number by itself, such that it does what those of any fur do here.
	let changed = 0;
	const attributes: Record<string, number[]> = { _comb: bends[2], _fur: [1, 1, 1, 0] };
	for (const [i, term] of terms.entries()) {
		const power = i % 3;
		const bent = [0, 1, 2].map((p) => terms.map((_, f) => (f === i && p === power ? general / (term * s ** p) : 0)));
		await page.route(new RegExp(`model\\.gltf\\?term=${i}$`), (route) => {
			changed++;
			const fur = { ...gltf.extensions.FUR_ptm_shells, bent };
			return route.fulfill({ json: { ...gltf, extensions: { FUR_ptm_shells: fur } } });
		});
		const drawn = await page.evaluate(([url, a, l]) => stage.vertices(url, 3, a, { lamp: l }), [
			served(`${golden}/model.gltf?term=${i}`),
			attributes,
			lamp,
		] as const);
		// Away from the rim, from texels that have moved by one to the left and one up.
		for (let texel = 9; texel < 54; texel++) {
			if (texel % 8 === 7 || texel % 8 === 0) continue;
			const wanted = expected[2 * 64 + texel - 8 + 1] ?? Number.NaN;
			expect(Math.abs((drawn.light[texel] ?? Number.NaN) - wanted), `term ${i}`).toBeLessThan(1e-3);
		}
	}
	expect(changed).toBe(terms.length);
});

test('combed hairs hide as much more as they lie along the skin', async ({ page }) => {
	await openStage(page);
	const { bends } = JSON.parse(await readFile(`${repository}${golden}/bent.json`, 'utf8'));
	const gltf = JSON.parse(await readFile(`${repository}${golden}/model.gltf`, 'utf8'));
	const fur = gltf.extensions.FUR_ptm_shells;
	const spread = 0.3;
	await page.route(/model\.gltf\?spread$/, (route) =>
		route.fulfill({ json: { ...gltf, extensions: { FUR_ptm_shells: { ...fur, spread } } } }),
	);
	const alphas = async (query: string, comb: number[], length: number) => {
		const attributes = { _comb: comb, _fur: [1, length, 1, 0] };
		const drawn = await page.evaluate(([url, a]) => stage.vertices(url, 3, a, { lamp: [0, 0, 1] }), [
			served(`${golden}/model.gltf${query}`),
			attributes,
		] as const);
		return drawn.alpha;
	};
	const across = ([u, v]: [number, number]) => u * u + v * v + spread * spread;
	// Slope of the top slab's hairs, from its middle on as from the one below it to there.
	const own = (fur.drift[3][1] - fur.drift[2][1]) * (fur.layers / fur.height);
	for (const [comb, length] of [
		[bends[0], 1],
		[bends[2], 1],
		[bends[2], 0.5],
		[[0, 0], 1],
	] as [number[], number][]) {
		const [x = 0, y = 0] = comb;
		const further = (2 * 0.875 * length) / Math.sqrt(1 - x * x - y * y);
		const power = Math.sqrt(across([further * x, own + further * y]) / across([0, own]));
		const [plain, combed] = [await alphas('', comb, length), await alphas('?spread', comb, length)];
		expect(Math.max(...plain)).toBeGreaterThan(0.5);
		expect(combed).toEqual(plain.map((alpha) => expect.closeTo(1 - (1 - alpha) ** power, 2)));
	}
});

test('sparse hairs hide more from aside, by how far their slope is from that of the view', async ({ page }) => {
	await openStage(page);
	const gltf = JSON.parse(await readFile(`${repository}${golden}/model.gltf`, 'utf8'));
	const fur = gltf.extensions.FUR_ptm_shells;
	const spread = 0.3;
	const shares = [0, 0.09, 0.2, 0.6];
	for (const open of shares)
		await page.route(new RegExp(`model\\.gltf\\?open=${open}$`), (route) =>
			route.fulfill({ json: { ...gltf, extensions: { FUR_ptm_shells: { ...fur, spread, open } } } }),
		);
	const [gu = 0, gv = 0] = [0, 1].map((c) => (fur.drift[3][c] - fur.drift[2][c]) * (fur.layers / fur.height));
	const before = Math.hypot(gu, gv, spread);
	// Skin that is turned against the lean and along it: its axes in those of the mesh, which lies in x and z and is seen along y.
	for (const side of [-1, 1]) {
		const tangent = [0.224 * side, -0.168 * side, -0.96 * side, 1];
		const turned = { normal: [0.6, 0.8, 0], tangent, _comb: [0, 0, 0], _fur: [1, 1, 1, 0] };
		const alphas = async (open: number) => {
			const url = served(`${golden}/model.gltf?open=${open}`);
			const drawn = await page.evaluate(([u, a]) => stage.vertices(u, 3, a, { lamp: [0, 0, 1] }), [
				url,
				turned,
			] as const);
			return drawn.alpha;
		};
		const [t, b, n] = [-0.168 * side, 0.576 * side, 0.8];
		const aside = Math.hypot(gu * n - t, gv * n - b, spread * n) / before;
		if (side < 0) expect(aside).toBeGreaterThan(1.2);
		else expect(aside, 'along the hairs, which hide no less than dust').toBeLessThan(0.8);
		const dust = await alphas(0);
		expect(Math.max(...dust)).toBeGreaterThan(0.5);
		for (const open of shares) {
			const sparse = Math.min(Math.max((open - 0.1) / 0.2, 0), 1);
			const power = 1 + sparse * (Math.max(aside, 1) - 1);
			expect(await alphas(open), `${open}`).toEqual(dust.map((alpha) => expect.closeTo(1 - (1 - alpha) ** power, 2)));
		}
	}
});

for (const name of ['ptm-6', 'eigen-6', 'eigen-3']) {
	test(`the sky lights bent hairs as lamps all around do: ${name}`, async ({ page }) => {
		await openStage(page);
		const combs = [
			[0.4, 0],
			[-0.3, 0.4],
			[0.1, -0.3],
		];
		const harmonics = [1.2, 0.3, -0.3, 0.35, 0.15, -0.1, 0.12, 0.18, -0.14];
		const drawn = await page.evaluate(([url, c, h]) => stage.dome(url, 2, c, h), [
			served(`tests/golden/${name}/model.gltf`),
			combs,
			harmonics,
		] as const);
		expect(drawn).toHaveLength(combs.length);
		for (const [i, { sky, lamps }] of drawn.entries()) {
			const seen = sky.flatMap((light, at) => (Number.isNaN(light) ? [] : [[light, lamps[at] ?? Number.NaN] as const]));
			expect(seen.length).toBeGreaterThan(20);
			const brightest = Math.max(...seen.map(([, truth]) => truth));
			const squares = seen.reduce((sum, [light, truth]) => sum + (light - truth) ** 2, 0);
			const error = Math.sqrt(squares / seen.length) / brightest;
			test.info().annotations.push({ type: `error at ${combs[i]}`, description: error.toFixed(4) });
			expect(error).toBeLessThan(0.02);
		}
	});
}
