/** Shells: which texels they show, how many there are, and where their light is summed. */

import { expect, test } from '../harness.ts';
import type { Stage } from '../inPage/stage.ts';
import { floats, openStage, readAsset, served } from '../library.ts';

declare const stage: Stage;

/** What shell `number` at height `s` shows: its slab, and how far hairs have drifted from that slab's middle. */
function shownAt(number: number, count: number, s: number, drift: readonly (readonly [number, number])[]) {
	const layers = drift.length;
	const knots = [[0, 0, 0], ...drift.map(([u, v], k) => [(k + 0.5) / layers, u, v])] as [number, number, number][];
	const after = Math.min(Math.max(knots.findIndex(([height]) => height > s) % knots.length, 1), knots.length - 1);
	const top = knots.every(([height]) => height <= s) ? knots.length - 1 : after;
	const [from, to] = [knots[top - 1], knots[top]] as [[number, number, number], [number, number, number]];
	const t = (s - from[0]) / (to[0] - from[0]);
	const nudge = count < layers ? 0.4 * (((0.618034 * number) % 1) - 0.5) : 1e-4;
	const slab = Math.min(Math.max(Math.floor(s * layers + nudge), 0), layers - 1);
	const at = [1, 2].map((axis) => (from[axis] ?? 0) + t * ((to[axis] ?? 0) - (from[axis] ?? 0)));
	return { slab, shear: at.map((value, axis) => value - (drift[slab]?.[axis] ?? 0)) };
}

test('a shell between slabs shows the nearer one, sheared so that hairs run on; all of them stand for the whole fur', async ({
	page,
}) => {
	await openStage(page);
	const folder = 'tests/golden/ptm-6';
	const { fur } = await readAsset(folder);
	const { drift, layers } = fur;
	const url = served(`${folder}/model.gltf`);
	const shell = (number: number, count: number, shift: number[]) =>
		page.evaluate(([u, n, c, s]) => stage.shell(u, n, c, s), [url, number, count, shift] as const);
	for (const [number, count, slabs, s] of [
		[0, 12, 1 / 3, 0.5 / 12], // below the first slab's middle
		[5, 12, 1 / 3, 5.5 / 12],
		[11, 12, 1 / 3, 11.5 / 12], // beyond the last slab's middle
		[1, 2, 2, 0.75], // fewer shells than slabs
		[0, 6, 1, 0.5 / 6], // alone in its slab
		[2, 6, 1 / 2, 2.5 / 6], // in one that it shares
		[6, 6.25, 0.25 / 1.25, 6.125 / 6.25], // the outermost of a broken number
	] as const) {
		const { slab, shear } = shownAt(number, count, s, drift);
		const [shown, straight] = await Promise.all([
			shell(number, count, [0, 0]),
			shell(
				slab,
				layers,
				shear.map((value) => -value),
			),
		]);
		const coverage = floats(straight);
		expect(Math.max(...coverage)).toBeGreaterThan(0.5);
		floats(shown).forEach((alpha, i) => {
			expect(alpha, `texel ${i} of shell ${number} of ${count}`).toBeCloseTo(1 - (1 - (coverage[i] ?? 0)) ** slabs, 3);
		});
	}
});

test('hairs stand apart above a round skin, and no closer above a hollow one', async ({ page }) => {
	await openStage(page);
	const folder = 'tests/golden/ptm-6-curves';
	const { fur } = await readAsset(folder);
	const top = fur.layers - 1;
	const s = (top + 0.5) / fur.layers;
	const draw = async (curvature: number[], length = 1) => {
		const attributes = { curvature: curvature.map((value) => value / fur.length), _fur: [1, length, 1, 0] };
		const { alpha } = await page.evaluate(([url, layer, a]) => stage.vertices(url, layer, a, { ambient: 1 }), [
			served(`${folder}/model.gltf`),
			top,
			attributes as Record<string, number[]>,
		] as const);
		return alpha;
	};
	const plain = await draw([0, 0, 0]);
	const fewer = (area: number) => plain.map((alpha) => expect.closeTo(1 - (1 - alpha) ** (1 / area), 3));
	expect(Math.max(...plain)).toBeGreaterThan(0.5);
	// A ball of two hairs' length in radius; a cylinder, whose curved way is at 60° to the first level axis.
	expect(await draw([0.5, 0.5, 0])).toEqual(fewer((1 + 0.5 * s) ** 2));
	expect(await draw([0.5 * 0.25, 0.5 * 0.75, -0.5 * Math.sqrt(3 / 16)])).toEqual(fewer(1 + 0.5 * s));
	expect(await draw([0.5, 0.5, 0], 0.5)).toEqual(fewer((1 + 0.25 * s) ** 2));
	expect(await draw([-0.5, -0.5, 0])).toEqual(plain);
	expect(await draw([9, 9, 0])).toEqual(fewer(4));
});

/** Of two pictures over a mid grey as a display shows them, dB. */
function psnr(a: Float32Array, b: Float32Array): number {
	const shown = (rgba: Float32Array, i: number) => {
		const linear = (rgba[i] ?? 0) + 0.2 * (1 - (rgba[i | 3] ?? 0));
		return Math.min(Math.max(linear, 0), 1) ** (1 / 2.2);
	};
	let [sum, count] = [0, 0];
	a.forEach((_, i) => {
		if ((a[i | 3] ?? 0) + (b[i | 3] ?? 0) === 0 || i % 4 === 3) return;
		sum += (shown(a, i) - shown(b, i)) ** 2;
		count++;
	});
	return -10 * Math.log10(sum / count);
}

const sumOf = (rgba: Float32Array) => rgba.reduce((sum, value, i) => (i % 4 === 3 ? sum : sum + value), 0);

const BUNNY = '/models/bunny/model.gltf';

test('the number of shells changes without a jump', async ({ page }) => {
	await openStage(page);
	// Past a whole number, and past one at which all shells lie where two slabs meet.
	const counts = [...[19.6, 19.7, 19.8, 19.9, 20, 20.1, 20.2], ...[7.8, 7.9, 8, 8.1, 8.2]];
	const pictures = await page.evaluate(([url, settings]) => stage.pictures(url, 200, settings), [
		BUNNY,
		counts.map((shells) => ({ shells })),
	] as const);
	const steps = pictures.slice(1).flatMap(({ rgba }, i) => {
		const step = Math.abs((counts[i + 1] ?? 0) - (counts[i] ?? 0));
		const [before, now] = [floats(pictures[i]?.rgba ?? ''), floats(rgba)];
		const brighter = sumOf(now) / sumOf(before) - 1;
		return step < 0.2 ? [{ few: (counts[i] ?? 0) < 12, dB: psnr(now, before), brighter }] : [];
	});
	const told = steps.map(({ dB, brighter }) => `${dB.toFixed(1)} dB, ${(100 * brighter).toFixed(2)} %`);
	test.info().annotations.push({ type: 'steps', description: told.join('; ') });
	// Eight shells show every other slab alone: 2 % brighter than 7.8 and 8.2 do, 6 % than 7.9 and 8.1.
	for (const { few, dB, brighter } of steps) {
		expect(dB).toBeGreaterThan(few ? 27 : 34); // texels with the contrast of hairs show steps more
		expect(Math.abs(brighter)).toBeLessThan(few ? 0.08 : 0.025);
	}
});

test('near fur is as bright as far fur: crisper hairs and more shells take and add next to no light', async ({
	page,
}) => {
	await openStage(page);
	for (const model of ['bunny', 'tiger']) {
		const sizes = [96, 864];
		const light: number[] = [];
		for (const size of sizes) {
			const [picture] = await page.evaluate(([url, pixels]) => stage.pictures(url, pixels, [{ shells: 'auto' }]), [
				`/models/${model}/model.gltf`,
				size,
			] as const);
			light.push(sumOf(floats(picture?.rgba ?? '')) / size ** 2);
		}
		const over = light.map((one) => one / (light[0] as number));
		test.info().annotations.push({ type: model, description: over.map((one) => one.toFixed(3)).join(' ') });
		for (const one of over) expect(Math.abs(one - 1)).toBeLessThan(0.04);
	}
});

for (const { shells, drawn } of [
	{ shells: 16, drawn: 11 },
	{ shells: 48, drawn: 27 },
])
	test(`of ${shells} shells ${drawn} stand for all, and the others go over to them without a step`, async ({
		page,
	}) => {
		await openStage(page);
		const merging = [0, 1, 0.59, 0.6, 0.61, 0.999];
		const pictures = await page.evaluate(([url, settings]) => stage.pictures(url, 240, settings), [
			BUNNY,
			merging.map((share) => ({ shells, distance: 0.5, merging: share })),
		] as const);
		const rgba = pictures.map((picture) => floats(picture.rgba));
		const [all, merged, before, between, after, last] = rgba as [
			Float32Array,
			Float32Array,
			Float32Array,
			Float32Array,
			Float32Array,
			Float32Array,
		];
		expect(pictures.map((picture) => picture.drawn)).toEqual([shells, drawn, ...merging.slice(2).map(() => shells)]);
		const dB = psnr(all, merged);
		test.info().annotations.push({ type: 'PSNR', description: `${dB.toFixed(1)} dB` });
		expect(dB).toBeGreaterThan(38);
		expect(Math.abs(sumOf(merged) / sumOf(all) - 1)).toBeLessThan(0.005);
		expect(psnr(before, between)).toBeGreaterThan(50);
		expect(psnr(between, after)).toBeGreaterThan(50);
		expect(psnr(last, merged), 'shells that are no longer drawn').toBeGreaterThan(50);
	});

test('lamps summed per vertex look as if summed per fragment, even on 512 triangles', async ({ page }) => {
	await openStage(page);
	const [vertex, fragment] = await page.evaluate(
		(url) =>
			stage.pictures(url, 240, [
				{ shells: 24, lampsPerFragment: false },
				{ shells: 24, lampsPerFragment: true },
			]),
		'/models/torus-512/model.gltf',
	);
	const [a, b] = [floats(vertex?.rgba ?? ''), floats(fragment?.rgba ?? '')];
	let [sum, count] = [0, 0];
	a.forEach((value, i) => {
		if (i % 4 === 3 || !a[i | 3]) return;
		const encode = (linear: number) => 255 * Math.min(Math.max(linear, 0), 1) ** (1 / 2.2);
		sum += (encode(value) - encode(b[i] ?? 0)) ** 2;
		count++;
	});
	const rmse = Math.sqrt(sum / count);
	test.info().annotations.push({ type: 'rmse', description: `${rmse.toFixed(2)} of 255` });
	expect(rmse).toBeLessThanOrEqual(3.2); // crisp hairs show the difference with more contrast
	expect(rmse, 'that it is another program').toBeGreaterThan(0);
});

for (const [model, trim] of [
	['torus-4608', 1],
	['bunny', 1],
	['bunny', 0.5],
] as const)
	test(`lamps and sky found once for all shells of a vertex light ${model}, ${trim} of its length, as if found at each`, async ({
		page,
	}) => {
		await openStage(page);
		const [once, each] = await page.evaluate(
			([url, cut]) =>
				stage.pictures(
					url,
					240,
					[true, false].map((bodyLight) => ({ shells: 24, bodyLight, trim: cut })),
				),
			[`/models/${model}/model.gltf`, trim] as const,
		);
		const [a, b] = [floats(once?.rgba ?? ''), floats(each?.rgba ?? '')];
		const dB = psnr(a, b);
		test.info().annotations.push({ type: 'PSNR', description: `${dB.toFixed(1)} dB` });
		expect(dB).toBeGreaterThan(47.5); // short hairs, which are brighter: 48.1
		expect(
			a.some((value, i) => value !== b[i]),
			'that it is another program',
		).toBe(true);
	});

for (const [model, least] of [
	['torus-4608', 90],
	['torus-512-eigen3', 55],
] as const)
	test(`${model}: hairs without a comb are lit as with one of no length`, async ({ page }) => {
		await openStage(page);
		const [without, combed] = await page.evaluate(
			(url) => stage.pictures(url, 240, [{ shells: 16 }, { shells: 16, combed: true }]),
			`/models/${model}/model.gltf`,
		);
		expect(without?.rgba).not.toBe('');
		const dB = psnr(floats(without?.rgba ?? ''), floats(combed?.rgba ?? ''));
		test.info().annotations.push({ type: 'PSNR', description: `${dB.toFixed(1)} dB` });
		expect(dB).toBeGreaterThan(least);
	});

test('coefficients of the nearest mip level look like a mixture of two', async ({ page }) => {
	await openStage(page);
	for (const distance of [0.5, 1.4]) {
		const [nearest, mixed] = await page.evaluate(
			([url, away]) =>
				stage.pictures(
					url,
					300,
					[false, true].map((mix) => ({ shells: 16, distance: away, mixed: mix })),
				),
			[BUNNY, distance] as const,
		);
		const [a, b] = [floats(nearest?.rgba ?? ''), floats(mixed?.rgba ?? '')];
		const dB = psnr(a, b);
		test.info().annotations.push({ type: `PSNR at ${distance}`, description: `${dB.toFixed(1)} dB` });
		// Drivers choose levels by rules of their own: SwiftShader 47 dB, an NVIDIA card 45, llvmpipe 44.
		expect(dB).toBeGreaterThan(43);
		expect(
			a.some((value, i) => value !== b[i]),
			'that levels differ',
		).toBe(true);
	}
});
