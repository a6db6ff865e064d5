/** Clips of a rigged model: played, held, scrubbed and chosen, in the panel and in the address; and nothing of them elsewhere. */

import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { CLIPS, type Clip, type Files, rigged } from '../../web/scene/clips/rigged.ts';
import { expect, open, settled, state, test } from '../harness.ts';
import { drawNothing, shrinkPicture } from '../inPage/gpu.ts';
import { psnr } from '../robust.ts';

test.use({ viewport: { width: 900, height: 760 } });

/** Serves a rigged model in the folder `models/walker/`. */
async function serve(page: Page, clips: readonly Clip[] = CLIPS): Promise<void> {
	await drawNothing(page);
	const files = rigged(clips);
	await page.route('**/models/walker/*', (route) => {
		const bytes = files[new URL(route.request().url()).pathname.split('/').at(-1) as string];
		return bytes ? route.fulfill({ body: Buffer.from(bytes) }) : route.fulfill({ status: 404 });
	});
}

/** Without a light of its own, which drifts. */
const WALKER = '?model=models/walker/&shells=2&light=-0.8,0.5,0.3';

const clip = (page: Page) => page.getByRole('combobox', { name: 'Clip' });
const play = (page: Page) => page.getByRole('checkbox', { name: 'Play', exact: true });
const field = (page: Page, name: string) =>
	page.locator('#panel').getByLabel(name, { exact: true }).locator('visible=true').last();
const time = async (page: Page) => Number(await field(page, 'Time, s').inputValue());
const said = (page: Page) => page.locator('.notice p');
const figures = (page: Page) => page.locator('#overlay');

async function set(page: Page, name: string, value: string): Promise<void> {
	await field(page, name).fill(value);
	await field(page, name).press('Enter');
}

/** Box of the body in the picture at rest: left, top, width and height. */
async function box(page: Page): Promise<[number, number, number, number]> {
	await expect.poll(() => state(page)).toBe('ready');
	await expect(figures(page)).toContainText('at rest');
	const sides = await page.locator('#picture').getAttribute('data-box');
	return (sides ?? '').split(',').map(Number) as [number, number, number, number];
}

async function drop(page: Page, files: Files): Promise<void> {
	const parts = Object.entries(files).map(([name, bytes]) => [name, Buffer.from(bytes).toString('base64')] as const);
	await page.evaluate((parts) => {
		const transfer = new DataTransfer();
		for (const [name, base64] of parts)
			transfer.items.add(new File([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))], name));
		document.body.dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: transfer }));
	}, parts);
}

test('the first clip plays by itself, in a loop, until it is held; at rest nothing is drawn', async ({ page }) => {
	await serve(page);
	await open(page, WALKER);
	await expect(clip(page)).toHaveValue('Walk');
	await expect(clip(page).locator('option')).toHaveText(['Walk', 'Leap', 'Go']);
	await expect(play(page)).toBeChecked();
	const seen: number[] = [];
	await expect(async () => {
		seen.push(await time(page));
		// Forwards, and from the end to the beginning.
		expect(seen.some((now, i) => now < (seen[i - 1] ?? 0))).toBe(true);
		expect(new Set(seen).size).toBeGreaterThan(4);
	}).toPass({ intervals: [100] });
	expect(Math.max(...seen)).toBeLessThanOrEqual(2);
	await expect(figures(page)).not.toContainText('at rest');

	await play(page).uncheck();
	await expect(figures(page)).toContainText('at rest');
	const held = await time(page);
	expect(Number(await settled(page, 'time'))).toBeCloseTo(held, 2);
	expect(await time(page)).toBe(held);

	await play(page).check();
	await expect(figures(page)).not.toContainText('at rest');
	await expect.poll(() => time(page)).not.toBe(held);
	await expect.poll(() => new URL(page.url()).searchParams.get('time')).toBe(null);
});

test('scrubbing, choosing and slowing down are in the address, and a link shows them again', async ({ page }) => {
	await serve(page);
	await open(page, `${WALKER}&still=1&camera=0,0,1`);
	await expect(play(page)).toBeDisabled();
	await expect(page.getByText('Clips are held, as the link asks.')).toBeVisible();
	const [, , flat, low] = await box(page);
	await set(page, 'Time, s', '1');
	expect(await settled(page, 'time')).toBe('1');
	const raised = await box(page);
	// A quarter turn of its right half: as high as it was wide there.
	expect(raised[3]).toBeGreaterThan(1.5 * low);
	expect(raised[2]).toBeLessThan(0.8 * flat);
	await set(page, 'Time, s', '9');
	expect(await settled(page, 'time')).toBe('2');
	expect(await box(page)).toEqual([expect.any(Number), expect.any(Number), flat, low]);

	await clip(page).selectOption('Leap');
	await set(page, 'Time, s', '0.5');
	expect(await settled(page, 'clip')).toBe('Leap');
	const leap = await box(page);
	const link = page.url();
	await open(page, '?model=sphere&shells=2&still=1');
	await open(page, new URL(link).search);
	expect(await box(page)).toEqual(leap);
	await expect(clip(page)).toHaveValue('Leap');
	expect(await time(page)).toBe(0.5);

	await open(page, `${WALKER}&speed=0.5`);
	await expect(field(page, 'Speed')).toHaveValue('0.5');
	await set(page, 'Speed', '2');
	expect(await settled(page, 'speed')).toBe('2');
	await page.getByRole('button', { name: 'Reset' }).click();
	expect(await settled(page, 'speed')).toBe(null);
	await expect(play(page)).toBeChecked();
});

test('each clip has the room that it needs, and the body stays on the ground', async ({ page }) => {
	await serve(page);
	const { width, height } = page.viewportSize() ?? { width: 0, height: 0 };
	for (const [name, times] of [
		['Walk', [0, 1]],
		['Leap', [0, 0.5]],
		['Go', [0, 1]],
	] as const) {
		const bottoms: number[] = [];
		for (const at of times) {
			await open(page, `${WALKER}&still=1&camera=0,0,1&clip=${name}&time=${at}`);
			const [left, top, wide, high] = await box(page);
			expect(Math.min(left, top), name).toBeGreaterThan(0);
			expect(left + wide, name).toBeLessThan(width);
			expect(top + high, name).toBeLessThan(height);
			bottoms.push(top + high);
		}
		const [first = 0, second = 0] = bottoms;
		if (name === 'Leap') expect(second).toBeLessThan(first - 50);
		else expect(Math.abs(second - first), name).toBeLessThan(3);
	}
});

test('where reduced motion is asked for, a clip is held at its beginning, and plays when it is told to', async ({
	page,
}) => {
	await page.emulateMedia({ reducedMotion: 'reduce' });
	await serve(page);
	await open(page, WALKER);
	await expect(figures(page)).toContainText('at rest');
	await expect(play(page)).not.toBeChecked();
	expect(await time(page)).toBe(0);
	await play(page).check();
	await expect.poll(() => time(page)).toBeGreaterThan(0);
	await page.getByRole('button', { name: 'Reset' }).click();
	await expect(play(page)).not.toBeChecked();
	await expect(figures(page)).toContainText('at rest');
});

test('a clip that is not there is told in a sentence; a model without clips has no controls and fetches no player', async ({
	page,
	watch,
}) => {
	await serve(page);
	await open(page, `${WALKER}&still=1&clip=Swim`);
	await expect(said(page)).toHaveText(['clip=Swim: expected Walk, Leap, Go; showing Walk']);
	await expect(clip(page)).toHaveValue('Walk');
	expect(await settled(page, 'clip')).toBe('Swim');
	await set(page, 'Time, s', '1');
	await expect.poll(() => new URL(page.url()).searchParams.get('clip')).toBe(null);
	// Another model has other clips, or none.
	await page.getByRole('combobox', { name: 'Model' }).selectOption('Sphere');
	await expect(clip(page)).toBeHidden();
	expect(await settled(page, 'time')).toBe(null);

	watch.requests.length = 0;
	await open(page, '?model=torus-512&shells=2&still=1&clip=Walk');
	await expect(said(page)).toHaveText(['clip=Walk: this model has no clips; ignored']);
	await expect(clip(page)).toBeHidden();
	expect(watch.requests.filter((url) => /ClipPlayer/.test(url))).toEqual([]);
});

test('a rigged model that is dropped moves: baked with its fur; unbaked, with words how to bake it', async ({
	page,
}) => {
	await drawNothing(page);
	await open(page, '?model=sphere&shells=2&still=0');
	const files = rigged();
	await drop(page, files);
	await expect(clip(page)).toHaveValue('Walk');
	await expect.poll(() => time(page)).toBeGreaterThan(0);
	await expect(said(page)).toHaveCount(0);

	const { extensions, ...plain } = JSON.parse(new TextDecoder().decode(files['model.gltf']));
	plain.extensionsUsed = plain.extensionsRequired = ['KHR_mesh_quantization'];
	const json = new TextEncoder().encode(JSON.stringify({ ...plain, buffers: [{ ...plain.buffers[0] }], images: [] }));
	await drop(page, { 'cat.gltf': new Uint8Array(json), 'model.bin': files['model.bin'] as Files[string] });
	await expect(said(page)).toContainText('npm run bake -- cat.gltf -o public/models/cat');
	await expect(said(page)).toContainText('Its clips come along: the fur moves with the body.');
	await expect.poll(() => time(page)).toBeGreaterThan(0);
});

test('axe finds nothing serious in the controls of clips, in either language and scheme', async ({ page }) => {
	await serve(page);
	for (const language of ['en', 'zh']) {
		await open(page, `${WALKER}&time=0.5&lang=${language}`);
		await expect(page.locator('#panel').getByRole('combobox')).toHaveCount(6);
		for (const colorScheme of ['light', 'dark'] as const) {
			await page.emulateMedia({ colorScheme });
			const { violations } = await new AxeBuilder({ page }).include('#panel').analyze();
			const serious = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
			expect(serious.map(({ id, nodes }) => [id, nodes[0]?.html])).toEqual([]);
		}
	}
});

const look = (page: Page) => page.getByRole('checkbox', { name: 'Look at the lamp', exact: true });

test('the bunny lives, but not out of sight, and with still=1 not at all', async ({ page }) => {
	await drawNothing(page);
	await open(page, '?shells=2&planes=64');
	await expect(clip(page).locator('option')).toHaveText(['idle', 'hop']);
	await expect.poll(() => time(page)).toBeGreaterThan(0);
	await expect(figures(page)).not.toContainText('at rest');
	await expect(look(page)).toBeChecked();
	const shift = (way: string) =>
		page.locator('#picture').evaluate((canvas, to) => canvas.style.setProperty('translate', to), way);
	await shift('300vw 0');
	await expect(figures(page)).toContainText('at rest');
	await shift('none');
	await expect(figures(page)).not.toContainText('at rest');
	await open(page, '?shells=2&planes=64&still=1');
	await expect(figures(page)).toContainText('at rest');
	expect(await time(page)).toBe(0);
	await expect(look(page)).toBeDisabled();
});

test('the bunny’s head turns to the lamp while its clip is held, and rests there; it can be told not to', async ({
	page,
}) => {
	await shrinkPicture(page, 160, 120, [0, 100], '#hint, #notices, #overlay');
	await open(page, '?shells=2&fins=0&planes=64&light=-1,0.2,0.3&time=0');
	const shot = async () => {
		await expect(figures(page)).toContainText('at rest');
		return page.locator('#picture').screenshot();
	};
	const looking = await shot();
	await look(page).uncheck();
	await expect(page).toHaveURL(/look=0/);
	expect(psnr(looking, await shot())).toBeLessThan(30);
});
