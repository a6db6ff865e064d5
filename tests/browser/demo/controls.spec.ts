/** Every control of the panel, by what the picture does; and every state as a link that shows the same picture again. */

import { readFile } from 'node:fs/promises';
import type { Page } from '@playwright/test';
import { decode } from 'fast-png';
import { difference, expect, frames, open, type Picture, state, test } from '../harness.ts';
import { shrinkPicture } from '../inPage/gpu.ts';

test.use({ viewport: { width: 900, height: 760 }, permissions: ['clipboard-read', 'clipboard-write'] });

/** A small picture in the middle of a page that is large enough for its panel, and nothing above it. */
const makeSmall = (page: Page) => shrinkPicture(page, 120, 90, [400, 280], '#split, #loading, #notices');

async function shot(page: Page): Promise<Picture & { data: ArrayLike<number> }> {
	await frames(page);
	const { width, height, data, channels } = decode(await page.locator('#picture').screenshot());
	const brightness = Float32Array.from({ length: width * height }, (_, i) => {
		const [r = 0, g = 0, b = 0] = data.subarray(i * channels, i * channels + 3);
		return (r + g + b) / 3;
	});
	return { width, height, brightness, data };
}

function psnr(a: { data: ArrayLike<number> }, b: { data: ArrayLike<number> }): number {
	let sum = 0;
	for (let i = 0; i < a.data.length; i++) sum += ((a.data[i] ?? 0) - (b.data[i] ?? 0)) ** 2;
	return 10 * Math.log10(255 ** 2 / (sum / a.data.length));
}

const ready = (page: Page) => expect.poll(() => state(page), { intervals: [50] }).toBe('ready');

/** Sets a control by its name, as one does with the keyboard. */
async function set(page: Page, name: string, value: string | boolean): Promise<void> {
	const exact = { name, exact: true };
	if (typeof value === 'boolean') await page.getByRole('checkbox', exact).setChecked(value);
	else if (await page.getByRole('combobox', exact).count()) await page.getByRole('combobox', exact).selectOption(value);
	else {
		const field = page.locator('#panel').getByLabel(name, { exact: true }).locator('visible=true').last();
		await field.fill(value);
		await field.press('Enter');
	}
	await ready(page);
}

const link = async (page: Page) => {
	await page.getByRole('button', { name: 'Copy link' }).click();
	await expect(page.getByRole('status')).toContainText('The link is copied');
	await page.getByRole('button', { name: 'Close this message' }).first().click();
	return page.evaluate(() => navigator.clipboard.readText());
};

/** Each step changes the picture; together they are a state, which `query` is to have in its link. */
const states: [query: string, tag: string[], steps: [name: string, value: string | boolean][]][] = [
	[
		'preset=fox&lights=3',
		['@long'],
		[
			['Preset', 'Fox'],
			['Lights', '3'],
			['Tip', '#7799ff'],
			['Environment', 'Sunset'],
		],
	],
	[
		'preset=wolf&method=eigen',
		[],
		[
			['Preset', 'Wolf'],
			['Method', 'Eigen'],
			['Length', '1.4'],
			['Density', '0.4'],
		],
	],
	[
		'method=lengyel&split=shadow-layers,0.5&exposure=2.5',
		['@long'],
		[
			['Method', 'Lengyel'],
			['Split with', 'Shadow layers'],
			['Exposure', '2.5'],
			['Auto shells', false],
			['Shells', '5'],
		],
	],
	[
		'fins=0&colour=402010,ff2200&crowd=3',
		[],
		[
			['Root', '#402010'],
			['Tip', '#ff2200'],
			['Fins', false],
			['Crowd', '3'],
		],
	],
];

for (const [query, tag, steps] of states)
	test(`every control changes the picture, and the state comes back from its link: ${query}`, { tag }, async ({
		page,
	}) => {
		await makeSmall(page);
		await open(page, '?model=torus-512&still=1');
		const first = await shot(page);
		let before = first;
		for (const [name, value] of steps) {
			await set(page, name, value);
			const after = await shot(page);
			// As many shells as there were: the next step says how many there are to be.
			if (name !== 'Auto shells') expect(difference(before, after), `${name} ${value}`).toBeGreaterThan(0.15);
			before = after;
		}
		const address = await link(page);
		for (const part of query.split('&')) expect(address).toContain(part);
		await page.goto(address);
		await ready(page);
		expect(psnr(before, await shot(page))).toBeGreaterThanOrEqual(45);
		await page.getByRole('button', { name: 'Reset' }).click();
		await ready(page);
		expect(psnr(first, await shot(page)), 'reset').toBeGreaterThanOrEqual(45);
	});

test('two methods stand side by side, each as it is alone; their line goes with mouse, keys and fingers', async ({
	page,
}) => {
	await makeSmall(page);
	await open(page, '?model=torus-512&still=1&shells=4&split=unlit,0.5&light=-.6,.5,.6');
	const line = page.getByRole('slider', { name: 'Line between PTM and Unlit' });
	const share = () => line.getAttribute('aria-valuenow').then(Number);
	expect(await share()).toBe(50);
	const both = await shot(page);
	await page.mouse.move(450, 650);
	await page.mouse.down();
	await page.mouse.move(430, 650, { steps: 3 });
	await page.mouse.up();
	expect(await share()).toBe(25);
	await line.press('ArrowRight');
	await line.press('Shift+ArrowUp');
	expect(await share()).toBe(37);
	expect(difference(both, await shot(page))).toBeGreaterThan(0.15);
	await expect.poll(() => new URL(page.url()).searchParams.get('split')).toBe('unlit,0.37');
	await line.press('Home');
	expect(await share()).toBe(2);
	const devtools = await page.context().newCDPSession(page);
	const touch = (type: string, x?: number) =>
		devtools.send('Input.dispatchTouchEvent', {
			type: type as 'touchStart',
			touchPoints: x === undefined ? [] : [{ x, y: 650 }],
		});
	const { x, width } = (await line.boundingBox()) ?? { x: 0, width: 0 };
	expect(width).toBeGreaterThanOrEqual(44);
	await touch('touchStart', x + width / 2);
	await touch('touchMove', 440);
	await touch('touchMove', 460);
	await touch('touchEnd');
	await expect.poll(share).toBe(50);
	expect(psnr(both, await shot(page))).toBeGreaterThanOrEqual(45);

	await set(page, 'Split with', 'None');
	await expect(line).toBeHidden();
	const left = await shot(page);
	await set(page, 'Method', 'Unlit');
	const right = await shot(page);
	const half = (whole: typeof both, first: boolean) => ({
		data: Array.from(whole.data).filter((_, i) => {
			const column = Math.floor(i / (whole.data.length / (whole.width * whole.height))) % whole.width;
			// The column that the line goes through may be of either.
			return first ? column < whole.width / 2 - 1 : column > whole.width / 2;
		}),
	});
	expect(psnr(half(both, true), half(left, true))).toBeGreaterThanOrEqual(45);
	expect(psnr(half(both, false), half(right, false))).toBeGreaterThanOrEqual(45);
	expect(psnr(half(left, true), half(right, true))).toBeLessThan(40);
});

test('the picture is saved as it is, without the lamp; where there is no clipboard the link is told', async ({
	page,
}) => {
	await makeSmall(page);
	await open(page, '?model=torus-512&still=1&shells=4&light=-.6,.5,.6');
	const [download] = await Promise.all([
		page.waitForEvent('download'),
		page.getByRole('button', { name: 'Save picture' }).click(),
	]);
	expect(download.suggestedFilename()).toBe('furbake-torus-512.png');
	const { width, height, channels, data } = decode(await readFile(await download.path()));
	expect([width, height]).toEqual([120, 90]);
	if (channels === 4) expect(data.filter((_, i) => i % 4 === 3).every((alpha) => alpha === 255)).toBe(true);
	const saved = { data: Array.from(data).filter((_, i) => channels === 3 || i % 4 !== 3) };
	await page.evaluate(() => {
		Object.defineProperty(navigator, 'clipboard', { value: undefined });
		document.execCommand = () => false;
	});
	await page.getByRole('button', { name: 'Copy link' }).click();
	await expect(page.getByRole('status')).toContainText('model=torus-512');
	await open(page, '?model=torus-512&still=1&shells=4&light=-.6,.5,.6&ui=0');
	const alone = await shot(page);
	const step = alone.data.length / (alone.width * alone.height);
	expect(psnr(saved, { data: Array.from(alone.data).filter((_, i) => i % step < 3) })).toBeGreaterThanOrEqual(45);
});
