/** Shadow maps on fur: what the bake has darkened is not darkened again, what others shade is. */

import { readFile } from 'node:fs/promises';
import type { Page } from '@playwright/test';
import type { BodyJob } from '../../../web/measure/bodyJob.ts';
import { expect, test } from '../harness.ts';
import type { Box } from '../inPage/neck.ts';
import { openInPage, repository, served } from '../library.ts';

declare const loaded: typeof import('../inPage/shade.ts') & typeof import('../inPage/neck.ts');

const MODEL = 'public/models/sphere/model.gltf';

/** The ball in a fur of one curve, that falls off to the dip. */
async function curved(page: Page): Promise<void> {
	const gltf = JSON.parse(await readFile(`${repository}${MODEL}`, 'utf8'));
	const fur = gltf.extensions.FUR_ptm_shells;
	const knots = Array.from({ length: 17 }, (_, x) => Math.min(x / 8, 1));
	fur.curves = { even: [[knots, knots, knots]], along: [[0, 0, 0].map(() => knots.map(() => 0))] };
	fur.version = '2.0';
	delete fur.environment;
	for (const pelt of fur.pelts) {
		pelt.weights = Array.from({ length: fur.layers }, () => [1]);
		delete pelt.fin.environment;
	}
	await page.route('**/sphere/model.gltf', (route) => route.fulfill({ json: gltf }));
}

for (const spot of [false, true]) {
	test(`a lone ball is as bright with a shadow map as without, in the shadow of another it is dark; spot: ${spot}`, async ({
		page,
	}) => {
		await openInPage(page, 'shade');
		await curved(page);
		const eyes = await page.evaluate(([u, s]) => loaded.terminator(u, s), [served(MODEL), spot] as const);
		const brightest = Math.max(...eyes.flatMap(({ plain }) => plain.filter((value) => !Number.isNaN(value))));
		let [compared, below] = [0, 0];
		for (const { plain, mapped } of eyes)
			for (const [bin, value] of plain.entries()) {
				if (!(value > 0.01 * brightest)) continue;
				const ratio = (mapped[bin] ?? Number.NaN) / value;
				test.info().annotations.push({
					type: `n·l ${(bin / 10 - 0.95).toFixed(2)}`,
					description: `${value.toFixed(4)} ${ratio.toFixed(3)}`,
				});
				expect(ratio).toBeGreaterThan(0.9);
				expect(ratio).toBeLessThan(1.1);
				compared++;
				if (bin < 9) below++;
			}
		expect(compared).toBeGreaterThan(20);
		expect(below).toBeGreaterThan(3);
		// The other ball stands between lamp and ball, in the middle of the lit side.
		expect((eyes[0]?.behind[19] ?? 1) / (eyes[0]?.plain[19] ?? 0)).toBeLessThan(0.25);
		expect((eyes[0]?.behind[15] ?? 0) / (eyes[0]?.plain[15] ?? 1)).toBeGreaterThan(0.9);
	});
}

const BUNNY = 'public/models/bunny/model.gltf';

/**
 * The bunny from the front left, the lamp above and beside its head; a box in the head's shadow on its neck, and one in the
 * light; and the first one's light over the other's where Mitsuba traces the strands (128 paths, by `study/verify/truth.py`).
 */
const necks: { lamp: BodyJob['cells'][0]['lamp']; boxes: [shaded: Box, lit: Box]; traced: number }[] = [
	{
		lamp: [-0.50944, 0.85624, 0.08561],
		boxes: [
			[72, 108, 100, 122],
			[130, 95, 165, 125],
		],
		traced: 0.0197 / 1.2687,
	},
	{
		lamp: [-0.74864, 0.65094, -0.12574],
		boxes: [
			[95, 80, 125, 130],
			[50, 105, 75, 125],
		],
		traced: 0.0065 / 0.9174,
	},
];

const jobOf = (lamp: BodyJob['cells'][0]['lamp']): BodyJob => ({
	width: 240,
	height: 200,
	fieldOfView: 20,
	centre: [0.0017, 0.0244, 0.0012],
	radius: 1.254,
	irradiance: 14.784,
	cells: [{ name: 'neck', view: 'left', eye: [-2.4126, 1.2691, 6.6344], lamp }],
	methods: [],
	passes: 0,
	brightest: 0,
	coloured: false,
});

for (const [i, { lamp, boxes, traced }] of necks.entries()) {
	test(`the head's shadow on the neck is as dark as it is traced, ${i}`, async ({ page }) => {
		await openInPage(page, 'neck');
		const [mapped, bare] = await page.evaluate(
			([url, job, where]) => loaded.means(url, job, where, [{ method: 'ptm' }, { method: 'ptm-bare' }]),
			[served(BUNNY), jobOf(lamp), boxes] as const,
		);
		const contrast = ([shaded = 1, lit = 0]: number[] = []) => shaded / lit;
		test.info().annotations.push({
			type: 'shaded over lit',
			description: `traced ${traced.toFixed(3)}, with map ${contrast(mapped).toFixed(3)}, without ${contrast(bare).toFixed(3)}`,
		});
		expect(Math.abs(contrast(mapped) - traced)).toBeLessThan(0.05);
		expect(contrast(bare)).toBeGreaterThan(traced + 0.2);
		// What is in the light stays there.
		expect(mapped?.[1] ?? 0).toBeGreaterThan(0.85 * (bare?.[1] ?? 1));
	});
}

test('one lamp of three casts a shadow on its own light alone', async ({ page }) => {
	await openInPage(page, 'neck');
	const { lamp, boxes } = necks[1] as (typeof necks)[0];
	const others: BodyJob['cells'][0]['lamp'][] = [
		[0.6, 0.3, 0.74],
		[-0.3, 0.2, 0.93],
	];
	const [once, all] = await page.evaluate(
		([url, job, where, more]) =>
			loaded.means(url, job, where, [
				{ method: 'ptm', others: more },
				{ method: 'ptm', others: more, lampsPerFragment: true },
			]),
		[served(BUNNY), jobOf(lamp), boxes, others] as const,
	);
	for (const [box, value] of (all ?? []).entries()) {
		test.info().annotations.push({
			type: 'light',
			description: `${once?.[box]?.toFixed(3)}, lamps per fragment ${value.toFixed(3)}`,
		});
		expect(value).toBeGreaterThan(0.1);
		expect((once?.[box] ?? 0) / value).toBeGreaterThan(0.93);
		expect((once?.[box] ?? 0) / value).toBeLessThan(1.07);
	}
});

test('light from behind comes through an ear, by the shadow map, and through nothing thick or round', async ({
	page,
}) => {
	await openInPage(page, 'neck');
	// From the right, the lamp behind and above. The ear, and all below the head's top.
	const view = { name: 'ear', view: 'right', eye: [2.4, 1.5, 6.6], lamp: [-0.351, 0.251, -0.902] } as const;
	const boxes: Box[] = [
		[110, 30, 130, 50],
		[0, 60, 240, 200],
	];
	const [dark, glowing, exact, bare, bareToo] = await page.evaluate(
		([url, job, where]) =>
			loaded.means(url, job, where, [
				{ method: 'ptm' },
				{ method: 'ptm', glow: 0.12 },
				{ method: 'ptm', glow: 0.12, lampsPerFragment: true },
				{ method: 'ptm-bare' },
				{ method: 'ptm-bare', glow: 0.12 },
			]),
		[served(BUNNY), { ...jobOf(view.lamp), cells: [{ ...view }] }, boxes] as const,
	);
	const [ear = 0, body = 0] = glowing?.map((value, i) => value - (dark?.[i] ?? 0)) ?? [];
	const description = `ear ${dark?.[0]?.toFixed(4)} + ${ear.toFixed(4)}, body ${dark?.[1]?.toFixed(4)} + ${body.toFixed(6)}`;
	test.info().annotations.push({ type: 'glow', description });
	expect(ear).toBeGreaterThan(0.04);
	expect(ear).toBeLessThan(0.2);
	expect(Math.abs(body)).toBeLessThan(0.002 * ear);
	expect(Math.abs((exact?.[0] ?? 0) - (glowing?.[0] ?? 1))).toBeLessThan(0.02);
	// Without a shadow map nothing is known of the body's thickness.
	expect(bareToo).toEqual(bare);
});
