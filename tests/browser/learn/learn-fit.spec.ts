/** Learn's figures on sampling, fit, bytes and numbers: what they say is what the baker measured and stored. */

import { readFile } from 'node:fs/promises';
import { decode } from 'fast-png';
import type { LessonRecord } from '../../../web/learn/data/measurements.ts';
import { expect, site, test } from '../harness.ts';

const file = (name: string) => readFile(new URL(`../../../public/${name}`, import.meta.url));
const record: LessonRecord = JSON.parse((await file('lesson/lesson.json')).toString());
const bake = JSON.parse((await file('models/torus-512-colour/bake.json')).toString());
const planes = await Promise.all(
	[0, 1].map(async (i) => decode(await file(`models/torus-512-colour/plane${i}.png`)).data),
);

test('lamps, texels, bits and numbers, by mouse and keyboard', async ({ page }) => {
	await page.setViewportSize({ width: 480, height: 700 });
	await page.emulateMedia({ reducedMotion: 'reduce' });
	// The other figures are another test's.
	await page.route(/\/assets\/en-[\w-]+\.js$/, async (route) => {
		const response = await route.fetch();
		const others = /data-figure="(?!dome|texel|bits|numbers)/g;
		await route.fulfill({ response, body: (await response.text()).replaceAll(others, 'data-left-out="') });
	});
	await page.goto(`${site}learn.html?still=1&lang=en#dome`);
	await expect(page.locator('figure[data-left-out]')).not.toHaveCount(0);
	const figure = (name: string) => page.locator(`figure[data-figure=${name}]`);
	const ready = async (name: string) => {
		await page.locator(`#${name} .try`).evaluate((text) => text.scrollIntoView());
		await expect(figure(name)).toHaveAttribute('data-state', 'ready');
	};

	// A click lights the lamp there, an arrow key its neighbour: each brings its own slice.
	await ready('dome');
	const dome = figure('dome').locator('canvas.dome');
	const slice = figure('dome').locator('canvas.slice');
	const lit = async () => Number(await dome.getAttribute('data-lamp'));
	const before = await lit();
	const box = await dome.boundingBox();
	await dome.click({ position: { x: (box?.width ?? 0) * 0.5, y: (box?.height ?? 0) * 0.16 } });
	await expect.poll(lit).not.toBe(before);
	const high = await lit();
	expect(record.lights[high]?.[2]).toBeGreaterThan(0.9);
	const bright = Number(await slice.getAttribute('data-mean'));
	const samples = decode(await file('lesson/samples07.png'));
	const row = samples.data.subarray(high * samples.width, (high + 1) * samples.width);
	const sumOfRow = [...row].reduce((total, value) => total + value, 0);
	const mean = (sumOfRow * (record.samples[1]?.scale ?? 0)) / row.length;
	expect(bright).toBeCloseTo(mean, 4);
	for (let i = 0; i < 9; i++) await dome.press('ArrowRight');
	await expect.poll(async () => record.lights[await lit()]?.[0]).toBeGreaterThan(0.85);
	expect(Number(await slice.getAttribute('data-mean'))).toBeLessThan(0.7 * bright);
	await figure('dome').getByRole('radio', { name: '4', exact: true }).check();
	await expect.poll(async () => Number(await slice.getAttribute('data-mean'))).toBeLessThan(0.4 * bright);
	await figure('dome').getByRole('radio', { name: '8', exact: true }).check();

	// The texel's six bytes are those of the models, and its light is what the six numbers give.
	await ready('texel');
	const texels = figure('texel').locator('canvas.picked');
	const picked = async () => ((await texels.getAttribute('data-texel')) ?? '').split(',').map(Number);
	const [column = 0, up = 0] = await picked();
	await texels.press('ArrowUp');
	await texels.press('ArrowRight');
	await expect.poll(picked).toEqual([column + 1, up + 1]);
	await expect(figure('texel').getByRole('status')).toHaveText(`texel (${column + 1}, ${up + 1})`);
	const sum = figure('texel').locator('.sum');
	const at = ((7 * 64 + up + 1) * 64 + column + 1) * 4;
	const stored = [0, 1, 2].map((channel) => planes[0]?.[at + channel]);
	stored.push(planes[1]?.[at], planes[1]?.[at + 1], planes[0]?.[at + 3]);
	const cells = figure('texel').locator('table tbody td');
	const read = async () => (await cells.allTextContents()).map((text) => Number(text.replace('−', '-')));
	// The table follows the keys with the next frame, and the sum with it.
	await expect(async () => {
		const numbers = await read();
		expect([1, 4, 7, 10, 13, 16].map((i) => numbers[i])).toEqual(stored);
	}).toPass({ intervals: [100] });
	const [lu = 0, lv = 0] = (/L\(([^)]*)\)/.exec((await sum.textContent()) ?? '')?.[1] ?? '')
		.split(', ')
		.map((text) => Number(text.replace('−', '-')));
	const numbers = await read();
	const [a0 = 0, a1 = 0, a2 = 0, a3 = 0, a4 = 0, a5 = 0] = [2, 5, 8, 11, 14, 17].map((i) => numbers[i]);
	const light = a0 * lu * lu + a1 * lv * lv + a2 * lu * lv + a3 * lu + a4 * lv + a5;
	// The light is told to two places, the numbers to four.
	const slope = Math.abs(2 * a0 * lu + a2 * lv + a3) + Math.abs(2 * a1 * lv + a2 * lu + a4);
	const rounding = 0.005 * slope + 0.000025 * (Math.abs(a0) + Math.abs(a1) + Math.abs(a2)) + 0.0003;
	expect(Math.abs(Number(await sum.getAttribute('data-stored')) - Math.max(light, 0))).toBeLessThan(rounding);
	const disc = await figure('texel').locator('canvas.lit').boundingBox();
	await figure('texel')
		.locator('canvas.lit')
		.click({ position: { x: (disc?.width ?? 0) / 2, y: (disc?.height ?? 0) / 2 } });
	await expect(sum).toContainText(/L\(−?0\.0/);

	// Bytes cost nothing that is seen; fewer bits do.
	await ready('bits');
	const says = figure('bits').locator('.note');
	await expect(says).toContainText(`${bake.fit.psnr_quantised.toFixed(2)} dB against what was measured`);
	await expect(says).toContainText(`${bake.fit.psnr_quantisation.toFixed(2)} dB against the unrounded`);
	const noise = async () => Number(await figure('bits').locator('canvas').nth(2).getAttribute('data-psnr'));
	expect(await noise()).toBeGreaterThan(50);
	for (let i = 0; i < 5; i++) await figure('bits').getByRole('slider').press('ArrowLeft');
	await expect.poll(noise).toBeLessThan(35);
	await expect(says).toContainText('3 bits or 2.25 bytes');

	// The same figures as the models’ own; with fewer numbers less.
	await ready('numbers');
	const words = figure('numbers').locator('.note').last();
	await expect(words).toContainText(`PTM ${bake.fit.psnr.toFixed(2)} dB`);
	await expect(words).toContainText(`at best ${bake.fit.bound.psnr.toFixed(2)} dB`);
	const ptm = async () => Number(await figure('numbers').locator('canvas.lit').first().getAttribute('data-psnr'));
	const six = await ptm();
	await figure('numbers').getByRole('radio', { name: '3', exact: true }).check();
	await expect.poll(ptm).toBeLessThan(six - 1);

	// On paper each stands whole on a page, be it A4 or Letter, with margins of an inch.
	await page.emulateMedia({ media: 'print' });
	await page.setViewportSize({ width: 602, height: 864 });
	for (const name of ['dome', 'texel', 'bits', 'numbers'])
		expect((await figure(name).boundingBox())?.height ?? Infinity, name).toBeLessThan(864);
});
