/** The bench's page: it measures when asked to, and hands on what other people's scripts rely on. */

import type { Page } from '@playwright/test';
import type { BenchFigures, Result } from '../../../web/measure/bench/results.ts';
import { expect, site, state, test } from '../harness.ts';
import type { coverage } from '../inPage/benchHerd.ts';
import { drawNothing } from '../inPage/gpu.ts';
import { openInPage } from '../library.ts';

// As wide as its tables.
test.use({ viewport: { width: 480, height: 360 } });

/** Opens the page, has it measure and takes what it sends. */
async function measured(page: Page, query: string): Promise<{ figures?: BenchFigures; error?: string }> {
	const sent = new Promise<{ figures?: BenchFigures; error?: string }>((resolve) => {
		void page.route('**/figures', async (route) => {
			await route.fulfill({ status: 204 });
			const message = route.request().postDataJSON();
			if (message.figures || message.error) resolve(message);
		});
	});
	await page.goto(`${site}bench.html?run=1&post=/figures&${query}`);
	return sent;
}

const rowOf = ({ method, light, fins }: Result) => `${method} ${light}${fins ? ' fins' : ''}`;

test('the page sends figures of the shape that is fixed, and shows them', async ({ page }) => {
	const { figures, error } = await measured(page, 'size=96x64&rounds=1&triangles=512&parts=results,layers');
	expect(error).toBeUndefined();
	expect(figures?.device).toMatch(/\S/);
	const software = /swiftshader/i.test(figures?.device ?? '');
	expect(figures?.clock).toBe(software ? 'readPixels' : 'timer query');
	const rows = [
		...['unlit', 'lengyel', 'shadow-layers', 'ptm', 'ptm3', 'ptm-colour'].map((method) => `${method} moving`),
		'shadow-layers still',
		'ptm still',
	];
	expect(figures?.results.map(rowOf)).toEqual([...rows, 'ptm moving fins']);
	expect(figures?.results_of_layers.map(rowOf)).toEqual(rows);
	for (const result of figures?.results ?? []) {
		expect(result).toMatchObject({ triangles: 512, shells: 16, width: 96, height: 64 });
		expect(result.median_ms).toBeGreaterThan(0);
		expect(result.ratio_to_unlit).toBeGreaterThan(0);
	}
	expect(figures?.results[0]?.ratio_to_unlit).toBe(1);
	expect(new Set(figures?.results_of_layers.map(({ triangles }) => triangles))).toEqual(new Set([32]));

	await expect.poll(() => state(page)).toBe('done');
	await expect(page.getByRole('status')).toHaveText('Done: the figures are below.');
	await expect(page.locator('.gallery figure')).toHaveCount(6);
	await expect(page.locator('table').first().locator('tbody tr')).toHaveCount(9);
	// Corners head nothing.
	await expect(page.locator('th:empty')).toHaveCount(0);
	await expect(page.locator('thead tr > td:first-child:empty')).not.toHaveCount(0);
	const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
	expect(wide).toBeLessThanOrEqual(0);
});

test('fragments are counted, not guessed', async ({ page }) => {
	const { figures } = await measured(page, 'size=160x90&rounds=1&triangles=512&parts=results&methods=ptm');
	const [shells, , fins] = figures?.results ?? [];
	const { covered, shaded, blended } = shells?.overdraw ?? { covered: 0, shaded: 0, blended: 0 };
	// The ring and its fur, seen from above its horizon, fill a third of the picture.
	expect(covered).toBeGreaterThan(0.25);
	expect(covered).toBeLessThan(0.5);
	// All 16 shells lie in front of the skin, a few of them twice; at the outline there are fewer.
	expect(shaded).toBeGreaterThan(10);
	expect(shaded).toBeLessThan(20);
	expect(blended).toBeGreaterThan(1);
	expect(blended).toBeLessThan(shaded);
	expect(fins?.overdraw?.shaded).toBeGreaterThan(shaded);
});

test('a herd is as many bodies, framed as one is', async ({ page }) => {
	await openInPage(page, 'benchHerd');
	const [alone, one, four] = await page.evaluate(() =>
		(globalThis as unknown as { loaded: { coverage: typeof coverage } }).loaded.coverage(),
	);
	expect(alone.share).toBeGreaterThan(0.2);
	expect(one.share / alone.share).toBeCloseTo(1, 2);
	expect(one.brightness / alone.brightness).toBeGreaterThan(0.9);
	expect(one.brightness / alone.brightness).toBeLessThan(1.1);
	// Four bodies, seen from 1 + 2.05 / 2 times as far.
	expect((four.share * 2.025 ** 2) / alone.share).toBeGreaterThan(3.6);
	expect((four.share * 2.025 ** 2) / alone.share).toBeLessThan(4.4);
});

test('frames upload nothing, wherever the light is', async ({ page }) => {
	await drawNothing(page);
	await page.addInitScript(() => {
		const context = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => unknown>;
		Object.assign(globalThis, { uploads: 0 });
		for (const name of Object.getOwnPropertyNames(context)) {
			if (!/^(bufferData|bufferSubData|(compressed)?Tex(Sub)?Image[23]D)$/i.test(name)) continue;
			const own = context[name];
			context[name] = function (...args) {
				(globalThis as unknown as { uploads: number }).uploads++;
				return own?.apply(this, args);
			};
		}
	});
	const uploads = async (rounds: number) => {
		const { figures } = await measured(
			page,
			`size=48x32&rounds=${rounds}&triangles=512&parts=results&methods=shadow-layers,ptm,ptm3`,
		);
		expect(figures?.rounds).toBe(rounds);
		await page.unroute('**/figures');
		return page.evaluate(() => (globalThis as unknown as { uploads: number }).uploads);
	};
	const once = await uploads(1);
	expect(once).toBeGreaterThan(20);
	expect(await uploads(2)).toBe(once);
});

test('nothing is measured unasked, and what the address says wrong is told, in either language', async ({ page }) => {
	await page.goto(`${site}bench.html?methods=magic`);
	await expect.poll(() => state(page)).toBe('ready');
	await expect(page.locator('#problem')).toHaveText(/methods=magic: expected some of unlit, lengyel/);
	await expect(page.locator('section')).toHaveCount(0);
	await page.getByRole('link', { name: '中文' }).click();
	await expect(page.locator('h1')).toHaveText('到底有多快？');
	await expect(page.locator('#problem')).toHaveText(/methods=magic，应为 unlit、lengyel/);
	await expect(page.locator('html')).toHaveAttribute('lang', 'zh-Hans');
});

test('a measurement can be stopped', async ({ page }) => {
	await page.goto(`${site}bench.html?run=1&rounds=many&size=96x64&triangles=512&methods=unlit`);
	await expect.poll(() => state(page)).toBe('running');
	await expect(page.locator('#problem'), 'told although it has started').toHaveText(/rounds=many/);
	await page.getByRole('button', { name: 'Stop' }).click();
	await expect.poll(() => state(page)).toBe('ready');
	await expect(page.getByRole('status')).toHaveText('Stopped.');
	await page.getByRole('button', { name: 'Measure' }).click();
	await expect.poll(() => state(page)).toBe('running');
	await page.getByRole('button', { name: 'Stop' }).click();
	await expect.poll(() => state(page)).toBe('ready');
	await expect(page.locator('#problem')).toBeHidden();
});
