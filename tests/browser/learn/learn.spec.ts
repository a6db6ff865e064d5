/** The lesson: figures say what was baked, move with the one light, and fail alone. */

import { readFileSync } from 'node:fs';
import { decode } from 'fast-png';
import { whole } from '../../../web/learn/words/whole.ts';
import { expect, open, site, state, test } from '../harness.ts';
import { apart, figure, pixels, show } from './figures.ts';

const models = new URL('../../../public/models/', import.meta.url);
const json = (path: string) => JSON.parse(readFileSync(new URL(path, models), 'utf8'));

test.use({ viewport: { width: 400, height: 320 } });

/** Coefficients of a pelt seen from straight above, from its files. */
function seenFromAbove(name: string): number[] {
	const { layers, size, pelts } = json(`${name}/model.gltf`).extensions.FUR_ptm_shells;
	const [p0, p1] = ['plane0.png', 'plane1.png'].map(
		(file) => decode(readFileSync(new URL(`${name}/${file}`, models))).data,
	);
	const { scale, bias } = pelts[0];
	const sums = [0, 0, 0, 0, 0, 0];
	for (let t = 0; t < size * size; t++) {
		let open = 1;
		for (let k = layers - 1; k >= 0; k--) {
			const at = 4 * (k * size * size + t);
			const stored = [p0?.[at], p0?.[at + 1], p0?.[at + 2], p1?.[at], p1?.[at + 1], p0?.[at + 3]];
			const alpha = (p1?.[at + 2] ?? 0) / 255;
			stored.forEach((byte = 0, i) => {
				sums[i] = (sums[i] ?? 0) + (open * alpha * scale[i] * (byte - bias[i])) / size ** 2;
			});
			open *= 1 - alpha;
		}
	}
	return sums;
}

test('figures say what was baked, and one light moves them all', async ({ page }) => {
	await open(page, 'learn.html?still=1&lang=en');
	expect(await state(page)).toBe('ready');
	await show(page, 'shells');
	const many = await pixels(page, 'shells');
	await page.getByRole('slider', { name: 'Shells' }).fill('2');
	await expect.poll(async () => apart(many, await pixels(page, 'shells'))).toBeGreaterThan(1);
	await expect(figure(page, 'shells').getByRole('status')).toHaveText('2');

	await show(page, 'slices');
	const { options } = json('pelt-paper/bake.json');
	await expect(figure(page, 'slices')).toContainText(
		`${options.layers} slices of ${options.size} × ${options.size} texels, ${options.coefficients} coefficients`,
	);
	const [pulled, before] = [await pixels(page, 'slices'), await pixels(page, 'shells')];
	await figure(page, 'slices').locator('canvas').focus();
	for (let i = 0; i < 8; i++) await page.keyboard.press('ArrowLeft');
	await expect.poll(async () => apart(pulled, await pixels(page, 'slices'))).toBeGreaterThan(0.5);
	await show(page, 'shells');
	await expect.poll(async () => apart(before, await pixels(page, 'shells'))).toBeGreaterThan(0.5);
	await show(page, 'slices');
	await page.getByRole('radio', { name: 'strands' }).check();
	const { strands } = JSON.parse(readFileSync(new URL('../lesson/lesson.json', models), 'utf8'));
	await expect(figure(page, 'slices')).toContainText(`${strands.strands} strands`);
});

test('the body has as many patches and fins as were baked', async ({ page }) => {
	await open(page, 'learn.html?still=1&lang=en#body');
	await show(page, 'body');
	const { asset } = json('bunny/bake.json');
	const numbers = (await figure(page, 'body').locator('.note').textContent()) ?? '';
	expect(numbers).toContain(`${whole(asset.skin.faces)} triangles of skin`);
	expect(numbers).toContain(
		`in all of ${whole(asset.shells.faces)} triangles, ${(asset.shells.faces / asset.skin.faces).toFixed(2)}`,
	);
	// Each fin is cut into four strips, so that light changes along its height.
	expect(numbers).toContain(`${whole(4 * asset.fins.faces)} triangles of fins`);
	for (const name of ['shells alone', 'a colour per patch', 'fins alone', 'hull', 'shells and fins']) {
		const before = await pixels(page, 'body');
		await page.getByRole('radio', { name }).check();
		await expect.poll(async () => apart(before, await pixels(page, 'body')), name).toBeGreaterThan(0.02);
	}
});

test('the article’s figures have the brightness of their coefficients', async ({ page, watch }) => {
	await page.route('**/lesson/strands.bin', (route) => route.fulfill({ body: 'hair' }));
	await open(page, 'learn.html?still=1&lang=en#paper');
	await expect(figure(page, 'tuft')).toHaveAttribute('data-state', 'failed');
	await expect(figure(page, 'tuft')).toContainText('lesson/strands.bin: got 4 bytes');
	expect(watch.complaints).toEqual([]);

	await show(page, 'turning');
	const a = seenFromAbove('torus-512-colour');
	// Where the lamp stands before anybody has moved it: x, y up, z; in the tile's frame v runs against z.
	const [x, y, z] = [-0.62, 0.62, 0.48].map((part) => part / Math.hypot(0.62, 0.62, 0.48)) as [number, number, number];
	const lit = (turn: number, of = a) => {
		const [c, s] = [Math.cos((turn * Math.PI) / 180), Math.sin((turn * Math.PI) / 180)];
		const [u, v] = [c * x + s * z, -(c * z - s * x)];
		return [u * u, v * v, u * v, u, v, 1].reduce((sum, phi, i) => sum + phi * (of[i] ?? 0), 0);
	};
	for (const turn of [0, 90, 180, 270])
		await expect(figure(page, 'turning')).toContainText(`${turn}°: mean L = ${lit(turn).toFixed(2)}`);
	expect(y).toBeGreaterThan(0);

	await show(page, 'short');
	const swings = ['torus-512-colour', 'pelt-short'].map((name) => {
		const of = seenFromAbove(name);
		const values = Array.from({ length: 36 }, (_, i) => lit(10 * i, of));
		const [least, most] = [Math.min(...values), Math.max(...values)];
		return Math.round((100 * (most - least)) / (most + least));
	});
	for (const swing of swings) await expect(figure(page, 'short')).toContainText(`± ${swing} %`);
	expect(swings[1]).toBeLessThan((swings[0] ?? 0) * 0.7);
});

test('the eye turns the nap: brighter than texels beside the lamp, darker against it', async ({ page }) => {
	await open(page, 'learn.html?still=1&lang=en#nap');
	await show(page, 'nap');
	const live = figure(page, 'nap').locator('.live');
	const slide = (label: string, to: string) => figure(page, 'nap').getByRole('slider', { name: label }).fill(to);
	/** Light of the plush in the middle of either picture. */
	const plush = async (nth: number) =>
		(await pixels(page, 'nap', nth))
			.filter((_, i) => Math.abs((i % 40) - 19.5) < 6 && Math.abs(i / 40 - 15) < 3)
			.reduce((sum, value) => sum + value, 0);
	const factor = async () => Number(await live.getAttribute('data-factor'));
	const seen: { factor: number; gain: number }[] = [];
	// The lamp stands at 180°, 38° high, until somebody takes it.
	for (const around of ['0', '165']) {
		await slide('Eye, around', around);
		const drawn = [await plush(0), await plush(1)] as const;
		seen.push({ factor: await factor(), gain: drawn[0] / drawn[1] });
	}
	const [against, beside] = seen as [(typeof seen)[0], (typeof seen)[0]];
	expect(against.factor).toBeLessThan(0.85);
	expect(beside.factor).toBeGreaterThan(1.05);
	expect(against.gain).toBeLessThan(0.9);
	expect(beside.gain).toBeGreaterThan(1.04);
	await expect(figure(page, 'nap')).toContainText(`× ${beside.factor.toFixed(2)}`);
	// The curves have the eye's point where their factor is.
	await expect(figure(page, 'nap').locator('.plot .value')).toHaveText(Array(2).fill(beside.factor.toFixed(2)));

	// A drag turns the eye, by arrow keys the lamp moves and the eye stays.
	const canvas = figure(page, 'nap').locator('canvas').first();
	await expect(page.locator('figure[data-state=loading]')).toHaveCount(0);
	await canvas.evaluate((element) => element.scrollIntoView({ block: 'center', behavior: 'instant' }));
	const { x = 0, y = 0, width = 0, height = 0 } = (await canvas.boundingBox()) ?? {};
	const eye = figure(page, 'nap').getByRole('slider', { name: 'Eye, around' });
	await page.mouse.move(x + 0.3 * width, y + 0.7 * height);
	await page.mouse.down();
	await page.mouse.move(x + 0.55 * width, y + 0.7 * height);
	await page.mouse.up();
	await expect(eye).toHaveValue('120');
	const before = await factor();
	await canvas.focus();
	for (let i = 0; i < 12; i++) await page.keyboard.press('ArrowRight');
	await expect.poll(async () => Math.abs((await factor()) - before)).toBeGreaterThan(0.1);
	await expect(eye).toHaveValue('120');

	// Under the lowest lamp the factor is largest: the curves stay in their plots.
	for (let i = 0; i < 12; i++) await page.keyboard.press('ArrowDown');
	await slide('Eye, height', '8');
	for (const around of ['-180', '0', '180']) {
		await slide('Eye, around', around);
		const beyond = await figure(page, 'nap')
			.locator('svg[role=img]')
			.evaluateAll((plots) =>
				plots.map((plot) => {
					const [room, curve] = [plot, plot.querySelector('path.ptm') as Element].map((each) =>
						each.getBoundingClientRect(),
					) as [DOMRect, DOMRect];
					return Math.max(room.left - curve.left, curve.right - room.right, room.top - curve.top);
				}),
			);
		expect(beyond).toHaveLength(2);
		expect(Math.max(...beyond), around).toBeLessThan(0);
	}
});

test('Table 1 is measured beside the article’s, and figures go on after it', async ({ page }) => {
	// Measuring itself has a test of its own; this one is about what becomes of it.
	const body = `export async function measureTable1({ quick }, signal, progress) {
		progress(0.5);
		return [512, 4608, 16896].map((triangles, i) => (
			{ triangles, layered: { fps: 100 + i }, ptm: { fps: 200 + i }, ratio: quick ? 2 + i / 10 : 0 }
		));
	}`;
	await page.route(/\/(assets\/table1-[\w-]+\.js|measure\/table1\.ts)/, (route) =>
		route.fulfill({ contentType: 'text/javascript', body }),
	);
	await open(page, 'learn.html?still=1&lang=en#rivals');
	await show(page, 'rivals');
	const [unlit, lengyel, layers, ptm] = await Promise.all([0, 1, 2, 3].map((nth) => pixels(page, 'rivals', nth)));
	for (const other of [unlit, lengyel, layers]) expect(apart(ptm ?? [], other ?? [])).toBeGreaterThan(1);
	// Lamps under which they differ are a click away.
	const put = async (name: string) => {
		await page.getByRole('button', { name }).click();
		await show(page, 'rivals');
	};
	await put('from above');
	await expect.poll(async () => apart(ptm ?? [], await pixels(page, 'rivals', 3))).toBeGreaterThan(1);
	const above = await pixels(page, 'rivals', 3);
	await put('behind the ring');
	await expect.poll(async () => apart(above, await pixels(page, 'rivals', 3))).toBeGreaterThan(3);
	const row = page.getByRole('row').filter({ hasText: '4 608' });
	await expect(row.getByRole('cell')).toHaveText(['14.3', '17.4', '1.22', '–', '–', '–']);
	await page.getByRole('button', { name: 'Measure here' }).click();
	await expect(row.getByRole('cell')).toHaveText(['14.3', '17.4', '1.22', '101.0', '201.0', '2.10']);
	// Figures go on after a measurement.
	const before = await pixels(page, 'rivals', 3);
	await figure(page, 'rivals').locator('canvas').nth(3).focus();
	for (let i = 0; i < 8; i++) await page.keyboard.press('ArrowRight');
	await expect.poll(async () => apart(before, await pixels(page, 'rivals', 3))).toBeGreaterThan(0.5);
});

test('a lost context comes back, and a finger scrolls', async ({ page }) => {
	await page.addInitScript(() => {
		const own = HTMLCanvasElement.prototype.getContext;
		HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...args: [never]) {
			const context = own.apply(this, args);
			if (context instanceof WebGL2RenderingContext)
				Object.assign(window, { lost: context.getExtension('WEBGL_lose_context') });
			return context;
		} as never;
	});
	await page.goto(`${site}learn.html?still=1&lang=zh`);
	await show(page, 'shells');
	await expect(page.locator('html')).toHaveAttribute('lang', 'zh-Hans');
	const before = await pixels(page, 'shells');
	await page.evaluate(async () => {
		const { lost } = window as unknown as { lost: WEBGL_lose_context };
		lost.loseContext();
		await new Promise((resolve) => setTimeout(resolve, 100));
		lost.restoreContext();
		await new Promise((resolve) => setTimeout(resolve, 100));
	});
	await expect.poll(async () => apart(before, await pixels(page, 'shells'))).toBeLessThan(0.1);
	const touch = await figure(page, 'shells')
		.locator('canvas')
		.first()
		.evaluate((canvas) => getComputedStyle(canvas).touchAction);
	expect(touch).toBe('pan-y');
});
