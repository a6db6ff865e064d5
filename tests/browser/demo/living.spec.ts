/** Living fur under the visitor's hands: stroked, blown at, wet in places, shaken; and all of it comes to rest. */

import type { Page } from '@playwright/test';
import { decode } from 'fast-png';
import { expect, frames, open, state, test } from '../harness.ts';
import { shrinkPicture } from '../inPage/gpu.ts';
import { psnr } from '../robust.ts';

test.use({ viewport: { width: 480, height: 420 }, permissions: ['clipboard-read', 'clipboard-write'] });

/** Of the picture on the page, CSS pixels. */
const [left, top, width, height] = [30, 120, 200, 160];
const centre = [left + width / 2, top + height / 2] as const;
const model = '?model=sphere&preset=bunny&shells=6&light=-.5,.5,.7&camera=0,0,.9';

/** A small picture between header and tools, and nothing over it. */
const makeSmall = (page: Page) =>
	shrinkPicture(page, width, height, [left, top], '#hint, #loading, #notices, #overlay');

async function shot(page: Page): Promise<Buffer> {
	await frame(page);
	return page.locator('#picture').screenshot();
}
const tool = (page: Page, name: string) => page.getByRole('radio', { name });
const ready = (page: Page) => expect.poll(() => state(page), { intervals: [50] }).toBe('ready');
/** Where no ring follows. */
const away = (page: Page) => page.mouse.move(10, 400);
const rests = (page: Page) => expect(page.locator('#overlay')).toContainText('at rest');

/** Drags over the picture, in its pixels from the middle, frame by frame. */
async function drag(page: Page, ...way: [x: number, y: number][]): Promise<void> {
	for (const [i, [x, y]] of way.entries()) {
		await page.mouse.move(centre[0] + x, centre[1] + y);
		if (i === 0) await page.mouse.down();
		await frame(page);
	}
	await page.mouse.up();
	await away(page);
	await frame(page);
}

const frame = (page: Page) => frames(page);

interface Region {
	/** mean brightness of the first and the second picture, 0..255 */
	means: [number, number];
	/** mean difference, 0..255 */
	difference: number;
	/** decibels between them */
	psnr: number;
}

/** What has become of a part of the picture. @param isIn by pixels from the middle */
function compare(before: Buffer, after: Buffer, isIn: (x: number, y: number) => boolean): Region {
	const [a, b] = [decode(before), decode(after)];
	const sums = { count: 0, first: 0, second: 0, away: 0, square: 0 };
	for (let i = 0; i < width * height; i++) {
		if (!isIn((i % width) + 0.5 - width / 2, Math.floor(i / width) + 0.5 - height / 2)) continue;
		for (let c = 0; c < 3; c++) {
			const [p, q] = [a.data[i * a.channels + c] ?? 0, b.data[i * b.channels + c] ?? 0];
			sums.count++;
			sums.first += p;
			sums.second += q;
			sums.away += Math.abs(p - q);
			sums.square += (p - q) ** 2;
		}
	}
	const { count, first, second, away, square } = sums;
	return {
		means: [first / count, second / count],
		difference: away / count,
		psnr: 10 * Math.log10(255 ** 2 / (square / count)),
	};
}

/** How much squares of 4 pixels vary in brightness, share of the mean: hairs are finer, locks are not. */
function locks(picture: Buffer, isIn: (x: number, y: number) => boolean): number {
	const { data, channels } = decode(picture);
	const squares: number[] = [];
	for (let y = 0; y < height; y += 4)
		for (let x = 0; x < width; x += 4) {
			if (!isIn(x + 2 - width / 2, y + 2 - height / 2)) continue;
			let sum = 0;
			for (let i = 0; i < 16; i++) sum += data[((y + (i >> 2)) * width + x + (i % 4)) * channels + 1] ?? 0;
			squares.push(sum);
		}
	const mean = squares.reduce((sum, value) => sum + value, 0) / squares.length;
	return Math.sqrt(squares.reduce((sum, value) => sum + (value / mean - 1) ** 2, 0) / squares.length);
}

test('a stroke leaves a lane that is seen, there alone, and recovers; a body that was shaken swings back', async ({
	page,
}) => {
	await makeSmall(page);
	await page.addInitScript(() => {
		const { prototype } = WebGL2RenderingContext;
		const link = prototype.linkProgram;
		prototype.linkProgram = function (program) {
			performance.mark('link');
			link.call(this, program);
		};
	});
	const links = () => page.evaluate(() => performance.getEntriesByName('link').length);
	await open(page, `${model}&still=1`);
	await rests(page);
	const [before, first] = [await shot(page), await links()];
	// By the keyboard: the light is before it.
	await tool(page, 'Move the light').focus();
	await page.keyboard.press('ArrowRight');
	await expect(tool(page, 'Stroke the fur')).toBeChecked();
	await expect.poll(links, 'when the tool is chosen').toBeGreaterThan(first);
	await rests(page);
	await drag(page, [-30, 0], [-15, 0], [0, 0], [15, 0], [30, 0]);
	const stroked = await shot(page);
	const inside = compare(before, stroked, (x, y) => Math.abs(x) < 25 && Math.abs(y) < 5);
	const outside = compare(before, stroked, (_x, y) => Math.abs(y) > 30);
	expect(inside.difference).toBeGreaterThan(12);
	expect(outside.psnr).toBeGreaterThan(40);
	await expect.poll(async () => psnr(before, await shot(page)), { intervals: [300] }).toBeGreaterThan(40);

	await tool(page, 'Grab and shake').check({ force: true });
	await page.mouse.move(...centre);
	await page.mouse.down();
	await page.mouse.move(centre[0] + 40, centre[1] - 20, { steps: 4 });
	await expect.poll(async () => psnr(before, await shot(page)), { intervals: [100] }).toBeLessThan(22);
	await page.mouse.up();
	await expect.poll(async () => psnr(before, await shot(page)), { intervals: [300] }).toBeGreaterThan(50);
	await rests(page);
});

test('wind moves the picture, and without it frames are still; a link with wind shows the same picture twice', async ({
	page,
}) => {
	await makeSmall(page);
	await open(page, `${model}&wind=.8,90`);
	const blown = await shot(page);
	await expect.poll(async () => psnr(blown, await shot(page)), { intervals: [200] }).toBeLessThan(38);
	await page.locator('#panel .lil-title').first().click();
	const wind = page.locator('#panel').getByLabel('Wind', { exact: true }).locator('visible=true').last();
	await wind.fill('0');
	await wind.press('Enter');
	await page.locator('#panel .lil-title').first().click();
	await rests(page);
	const calm = await shot(page);
	await page.waitForTimeout(400);
	expect(psnr(calm, await shot(page))).toBeGreaterThan(50);
	expect(psnr(blown, calm)).toBeLessThan(38);
	await expect.poll(() => new URL(page.url()).searchParams.get('wind')).toBe(null);

	const pictures: Buffer[] = [];
	for (let i = 0; i < 2; i++) {
		await open(page, `${model}&wind=.8,90&still=1`);
		await rests(page);
		pictures.push(await shot(page));
	}
	const [first, second] = pictures as [Buffer, Buffer];
	expect(first.equals(second)).toBe(true);
	expect(psnr(calm, first)).toBeLessThan(38);
});

test('rain wets the fur under the brush, and there alone; the link says what it does not tell', async ({ page }) => {
	await makeSmall(page);
	// So near that locks can be told from hairs.
	await open(page, `${model.replace('&preset=bunny', '').replace(',.9', ',.45')}&still=1`);
	const dry = await shot(page);
	await tool(page, 'Rain').check({ force: true });
	await ready(page);
	const before = await shot(page);
	// The pelt that knows wet fur looks as the fur did.
	expect(psnr(dry, before)).toBeGreaterThan(37.5);
	const isIn = (x: number, y: number) => Math.abs(x) < 24 && Math.abs(y) < 12;
	await page.mouse.move(...centre);
	await page.mouse.down();
	let round = 0;
	const share = async () => {
		const side = round++ % 2 ? 1 : -1;
		await page.mouse.move(centre[0] - 24 * side, centre[1] - 7 * side);
		await frame(page);
		await page.mouse.move(centre[0] + 24 * side, centre[1] - 7 * side);
		await frame(page);
		const [first, second] = compare(before, await shot(page), isIn).means;
		return second / first;
	};
	await expect.poll(share, { intervals: [50] }).toBeLessThan(0.8);
	await page.mouse.up();
	await away(page);
	await frame(page);
	const wet = await shot(page);
	const inside = compare(before, wet, isIn);
	const outside = compare(before, wet, (x, y) => Math.abs(x) > 64 || Math.abs(y) > 48);
	expect(inside.means[1]).toBeLessThan(0.8 * inside.means[0]);
	expect(locks(wet, isIn)).toBeGreaterThan(1.3 * locks(before, isIn));
	expect(outside.psnr).toBeGreaterThan(45);
	await page.locator('#panel .lil-title').first().click();
	await page.getByRole('button', { name: 'Copy link' }).click();
	await expect(page.getByRole('status')).toContainText('not in the link');
	await page.getByRole('button', { name: 'Dry and clean' }).click();
	await page.locator('#panel .lil-title').first().click();
	await expect.poll(async () => psnr(before, await shot(page)), { intervals: [200] }).toBeGreaterThan(50);
});
