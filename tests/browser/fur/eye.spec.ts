/** The law of light and eye in the shaders: its terms, powers of the height and surge, and a sky beside lamps all around. */

import { readFile } from 'node:fs/promises';
import type { Page } from '@playwright/test';
import type { FurAsset } from '../../../web/fur/format.ts';
import { leanOf, wayOf } from '../../../web/fur/light/bent.ts';
import { expect, test } from '../harness.ts';
import type { Stage } from '../inPage/stage.ts';
import { floats, leaning, openStage, repository, served } from '../library.ts';

declare const stage: Stage;

type Vector = [number, number, number];

const golden = 'tests/golden/ptm-6-curves';
const zeros = () => [0, 1, 2].map(() => new Array<number>(16).fill(0));
const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** T, B and N of skin that is turned against the plane, in the plane's own axes: it is seen along the third. */
const [sine, cosine] = [0.6, 0.8];
const frame: [Vector, Vector, Vector] = [
	[0.28 * cosine, 0.96, -0.28 * sine],
	[-0.96 * cosine, 0.28, 0.96 * sine],
	[sine, 0, cosine],
];
/** From the plane's axes to those of its mesh, which lies in x and z. */
const ofMesh = ([right, up, out]: Vector) => [right, out, -up];
const attributes = {
	normal: ofMesh(frame[2]),
	tangent: [...ofMesh(frame[0]), 1],
};
/** Length of hairs that stand where they would untilted. */
const SHORT = 1e-4;

async function openEyes(page: Page): Promise<(laws: object[]) => Promise<string[]>> {
	await openStage(page);
	const gltf = JSON.parse(await readFile(`${repository}${golden}/model.gltf`, 'utf8'));
	return async (laws) => {
		for (const [i, law] of laws.entries())
			await page.route(new RegExp(`model\\.gltf\\?eye=${i}$`), (route) => {
				const fur = {
					...gltf.extensions.FUR_ptm_shells,
					length: SHORT,
					...law,
				};
				return route.fulfill({
					json: { ...gltf, extensions: { FUR_ptm_shells: fur } },
				});
			});
		return laws.map((_, i) => served(`${golden}/model.gltf?eye=${i}`));
	};
}

/** Mean light of layer 3 under a lamp, of hairs with this share of their length. */
async function lit(page: Page, url: string, lamp: Vector, share = 1, perFragment = false): Promise<number> {
	const look = { lamp, perFragment };
	const own = { ...attributes, _fur: [1, share, 1, 0] };
	const drawn = await page.evaluate(([u, a, l]) => stage.vertices(u, 3, a, l), [url, own, look] as const);
	return drawn.light.reduce((sum, light) => sum + light, 0) / drawn.light.length;
}

/** Pelts of dark grey hairs, with a share of light from the eye that has met several, which counts `gain` times. */
async function darkHairs() {
	const { pelts, layers, drift, height } = JSON.parse(await readFile(`${repository}${golden}/model.gltf`, 'utf8'))
		.extensions.FUR_ptm_shells;
	const [colour, albedo, ratio, straight] = [0.3, 0.8, 0.7, 0.5];
	const every = <T>(value: T) => new Array<T>(layers).fill(value);
	const multiple = { albedo, shares: every([straight, 0, 0]), ratio: every(ratio), seen: every(0.25), tint: every(1) };
	const grey = [colour, colour, colour];
	const ramp = { root: grey, tip: grey, tip2: grey, power: 1 };
	const many = pelts.map((pelt: object) => ({ ...pelt, multiple }));
	const gain = ((colour / albedo) * (1 - ratio * albedo)) / (1 - ratio * colour);
	const share = straight * leaning({ drift, height }, [frame[0][2], frame[1][2], frame[2][2]]);
	return { ramp, many, share, gain };
}

test('every number meets its term and power of the height', async ({ page }) => {
	const open = await openEyes(page);
	const { drift } = JSON.parse(await readFile(`${repository}${golden}/model.gltf`, 'utf8')).extensions.FUR_ptm_shells;
	const m = wayOf({ drift });
	const lamp: Vector = [0.48, 0.36, 0.8];
	const [l, v] = [lamp, [0, 0, 1] as Vector].map((way) => frame.map((axis) => dot(axis, way)) as Vector) as [
		Vector,
		Vector,
	];
	const [a, b, p, z, q] = [
		l[0] * v[0] + l[1] * v[1],
		l[0] * m[0] + l[1] * m[1],
		v[0] * m[0] + v[1] * m[1],
		l[2],
		1 - v[2] ** 2,
	];
	const terms = [q, a, q * b, p * b, q * z, q * b * b, p, a * a, p * a * b, q * p, q * b * z, q * a * b];
	terms.push(a * z, p * z, q * z * z, q * p * b);
	const s = 3.5 / 4;
	// One number by itself, such that the light is 1.25 times what it was.
	const laws = terms.map((term, f) => {
		const eye = zeros();
		const row = eye[f % 3];
		if (row) row[f] = 0.25 / (term * s ** (f % 3));
		return { eye };
	});
	const urls = await open([{ eye: zeros() }, ...laws]);
	const plain = await lit(page, urls[0] ?? '', lamp);
	expect(plain).toBeGreaterThan(0.1);
	for (const [f] of terms.entries())
		expect((await lit(page, urls[f + 1] ?? '', lamp)) / plain, `term ${f}`).toBeCloseTo(1.25, 3);
});

test('light of a lamp beside the eye surges, more where it is seen from aside', async ({ page }) => {
	const open = await openEyes(page);
	const [plain = '', surging = ''] = await open([{}, { eye: zeros(), surge: [0.2, 0.5, 0.1] }]);
	const most = 0.2 + 0.5 * (1 - cosine ** 2);
	for (const angle of [0, 0.1, 0.5]) {
		const lamp: Vector = [Math.sin(angle), 0, Math.cos(angle)];
		const gain = 1 + most / (1 + (2 - 2 * Math.cos(angle)) / 0.01);
		expect((await lit(page, surging, lamp)) / (await lit(page, plain, lamp)), `${angle}`).toBeCloseTo(gain, 2);
	}
});

test('light along hairs that lean counts more, the more they lean', async ({ page }) => {
	const open = await openEyes(page);
	const { drift, height } = JSON.parse(await readFile(`${repository}${golden}/model.gltf`, 'utf8')).extensions
		.FUR_ptm_shells as FurAsset;
	const [m, own] = [wayOf({ drift }), leanOf({ drift, height }).length()];
	// The body is flat: β = 16.
	for (const lean of [0.8, 1.4, 2.2]) {
		const leaning = { drift: drift.map(([u, v]) => [(u * lean) / own, (v * lean) / own]) };
		const [plain = '', told = ''] = await open([leaning, { ...leaning, eye: zeros() }]);
		for (const lamp of [
			[0.6, 0.3, 0.74],
			[-0.6, 0.5, 0.62],
			[0.8, -0.5, -0.33],
		] as Vector[]) {
			const [t, b] = frame.map((axis) => dot(axis, lamp)) as Vector;
			const along = m[0] * t + m[1] * b;
			const more = Math.min(Math.max((12 * lean) / 16 - 0.8, 0), 1) * along ** 2 * (0.28 + 0.16 * along) * cosine ** 2;
			const factor = (await lit(page, told, lamp)) / (await lit(page, plain, lamp));
			expect(factor, `${lean}, ${lamp}`).toBeCloseTo(1 + more * (1 - Math.abs(lamp[2])), 3);
		}
		await page.unrouteAll();
	}
});

test('the factor is never less than a tenth', async ({ page }) => {
	const open = await openEyes(page);
	const dark = zeros();
	if (dark[0]) dark[0][0] = -10;
	const [plain = '', held = ''] = await open([{}, { eye: dark }]);
	expect((await lit(page, held, [0, 0, 1])) / (await lit(page, plain, [0, 0, 1]))).toBeCloseTo(0.1, 3);
});

test('of light to an eye aside the less has met several hairs the brighter it is', async ({ page }) => {
	const open = await openEyes(page);
	const { ramp, many, share, gain } = await darkHairs();
	for (const [nap, surge, perFragment] of [
		[1.3, 1, false],
		[0.7, 1.4, true],
		[0.5, 1, false],
	] as const) {
		const eye = zeros();
		if (eye[0]) eye[0][0] = (nap - 1) / (1 - cosine ** 2);
		const law = { ramp, eye, surge: [surge - 1, 0, 0.1] };
		const [plain = '', told = ''] = await open([law, { ...law, pelts: many }]);
		const light = (url: string) => lit(page, url, [0, 0, 1], 1, perFragment);
		const several = Math.min(share / (nap ** 1.5 * surge), 1);
		expect((await light(told)) / (await light(plain)), `${nap}`).toBeCloseTo(1 + several * (gain - 1), 2);
		await page.unrouteAll();
	}
});

test('of shorter hairs, which lie flatter, less steep light has met several', async ({ page }) => {
	const open = await openEyes(page);
	const { ramp, many, share, gain } = await darkHairs();
	const law = { ramp, eye: zeros() };
	const [plain = '', tinged = ''] = await open([law, { ...law, pelts: many }]);
	for (const length of [1, 0.5]) {
		const light = (url: string) => lit(page, url, [0, 0, 1], length);
		const nap = 1 + (1 - length) * (0.3 + 0.4) * (1 - cosine ** 2);
		const several = (share * (1 + (1 - length ** 2) * (0.2 - 0.5 * Math.sqrt(cosine)))) / nap ** 1.5;
		expect((await light(tinged)) / (await light(plain)), `${length}`).toBeCloseTo(1 + several * (gain - 1), 2);
	}
});

test('a fin has no surge, and shows at most what an upright hair sends back to a lamp beside the eye', async ({
	page,
}) => {
	const open = await openEyes(page);
	const bright = zeros();
	if (bright[0]) bright[0][0] = 10;
	const urls = await open([{}, { eye: bright }, { eye: zeros(), surge: [2, 2, 0.4] }]);
	const [plain, most, surging] = await Promise.all(
		urls.map(async (url) => {
			const { light } = await page.evaluate((u) => stage.fin(u, [[0, 0.6, 0.8]]), url);
			return floats(light).reduce((sum, one) => sum + (one > 0 ? one : 0), 0);
		}),
	);
	expect(plain).toBeGreaterThan(1);
	// A Lambertian cylinder sends sin φ + (π − φ)·cos φ to an eye at φ from the lamp.
	const steps = Array.from({ length: 1000 }, (_, i) => (Math.PI * (i + 0.5)) / 1000);
	const mean = steps.reduce((sum, phi) => sum + Math.sin(phi) + (Math.PI - phi) * Math.cos(phi), 0) / 1000;
	expect((most ?? 0) / (plain ?? 1)).toBeCloseTo(Math.PI / mean, 2);
	expect((surging ?? 0) / (plain ?? 1)).toBeCloseTo(1, 3);
});

test('a fin with numbers of its own shows light by them, and its eye is on the horizon', async ({ page }) => {
	const open = await openEyes(page);
	const [finEye, bright] = [zeros(), zeros()];
	if (finEye[0] && bright[0]) [finEye[0][0], bright[0][0]] = [0.25, 2];
	const urls = await open([{ eye: zeros() }, { eye: bright, finEye }]);
	for (const tilt of [0, 0.1]) {
		const [plain = 0, own = 0] = await Promise.all(
			urls.map(async (url) => {
				const { light } = await page.evaluate(([u, t]) => stage.fin(u, [[0, 0.6, 0.8]], t), [url, tilt] as const);
				return floats(light).reduce((sum, one) => sum + (one > 0 ? one : 0), 0);
			}),
		);
		expect(own / plain, `${tilt}`).toBeCloseTo(1.25, 3);
	}
});

test('shorter hairs grow in light, and are seen through the pelt, brighter from aside', async ({ page }) => {
	const open = await openEyes(page);
	const [growth, eye] = [[0.3, 0.4, -0.2] as const, zeros()];
	// The eye's q alone, at all heights.
	if (eye[0]) eye[0][0] = 0.5;
	const [plain = '', growing = '', aside = '', surging = ''] = await open([
		{},
		{ short: growth },
		{ eye },
		{ eye: zeros(), surge: [0.2, 0.5, 0.1] },
	]);
	const s = 3.5 / 4;
	const through = ([t, b, n]: Vector, share: number): Vector => {
		const way: Vector = [t, b, n / share];
		const length = Math.hypot(...way);
		return way.map((part) => part / length) as Vector;
	};
	const lamp: Vector = [0.3, 0.1, Math.sqrt(0.9)];
	const inFrame = (way: Vector) => frame.map((axis) => dot(axis, way)) as Vector;
	const [light, toEye] = [inFrame(lamp), inFrame([0, 0, 1])];
	const asItIs = { q: toEye[0] ** 2 + toEye[1] ** 2, a: toEye[0] * light[0] + toEye[1] * light[1] };
	for (const [share, perFragment] of [
		[1, false],
		[0.5, false],
		[0.2, true],
		[0.01, false],
	] as const) {
		const counts = Math.max(share, 1 / 16);
		const whole = await lit(page, plain, lamp, share, perFragment);
		const over = async (url: string) => (await lit(page, url, lamp, share, perFragment)) / whole;
		expect(await over(growing), `growth, ${share}`).toBeCloseTo(
			1 - Math.log(counts) * (growth[0] + growth[1] * s + growth[2] * s * s),
			2,
		);
		const [l, v] = [through(light, counts), through(toEye, counts)];
		const q = 1 - v[2] ** 2;
		const shorter = 1 + (1 - counts) * (0.3 * asItIs.q + 0.4 * asItIs.a);
		expect(await over(aside), `eye, ${share}`).toBeCloseTo(shorter + 0.5 * q, 2);
		const apart = (l[0] - v[0]) ** 2 + (l[1] - v[1]) ** 2 + (l[2] - v[2]) ** 2;
		const surge = 1 + (0.2 + 0.5 * q) / (1 + apart / 0.01);
		expect(await over(surging), `surge, ${share}`).toBeCloseTo(shorter * surge, 2);
	}
});

test('the sky lights hairs of any length, seen from aside, as lamps all around do', async ({ page }) => {
	const open = await openEyes(page);
	const { eye, surge, short } = JSON.parse(await readFile(`${repository}public/models/bunny/model.gltf`, 'utf8'))
		.extensions.FUR_ptm_shells;
	const [url = ''] = await open([{ eye, surge, short }]);
	const harmonics = [1.2, 0.3, -0.3, 0.35, 0.15, -0.1, 0.12, 0.18, -0.14];
	// On a ball of β = 4.
	const curvature = [0.25 / SHORT, 0.25 / SHORT, 0];
	for (const share of [1, 0.5, 0.2, 0.08]) {
		const own = { ...attributes, curvature, _fur: [1, share, 1, 0] };
		const drawn = await page.evaluate(([u, h, a]) => stage.dome(u, 2, [[0, 0]], h, undefined, a), [
			url,
			harmonics,
			own,
		] as const);
		const [sky, lamps] = (['sky', 'lamps'] as const).map((by) =>
			(drawn[0]?.[by] ?? []).reduce((sum, light) => sum + (Number.isNaN(light) ? 0 : light), 0),
		) as [number, number];
		expect(lamps).toBeGreaterThan(1);
		expect(Math.abs(sky / lamps - 1), `${share}`).toBeLessThan(share < 0.1 ? 0.05 : 0.03);
	}
});
