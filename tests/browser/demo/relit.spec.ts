import type { Page } from '@playwright/test';
import { decode, encode } from 'fast-png';
import { expect, open, settled, state, test } from '../harness.ts';
import { dropFiles, type Files } from './dropFiles.ts';

test.use({ viewport: { width: 200, height: 150 } });

type Light = [number, number, number];

const [WIDTH, HEIGHT] = [8, 6];
const SCALE = [0.5, 0.5, 0.4, 0.6, 0.6, 1];
const BIAS = [128, 120, 128, 128, 128, 0];

/** Bytes of a picture of two halves, lowest row first: six coefficients a pixel; colours are 200, 150, 100. */
const coefficients = (x: number, y: number) =>
	x < WIDTH / 2 ? [128, 120, 128, 228, 128, 130] : [128, 120, 128, 128, y < HEIGHT / 2 ? 28 : 228, 130];
const COLOUR = [200, 150, 100];

const head = (kind: string) =>
	`PTM_1.2\nPTM_FORMAT_${kind}\n${WIDTH}\n${HEIGHT}\n${SCALE.join(' ')}\n${BIAS.join(' ')}\n`;
const pixels = Array.from({ length: WIDTH * HEIGHT }, (_, i) => [i % WIDTH, Math.floor(i / WIDTH)] as const);
const bytes = (...parts: (string | number[])[]) =>
	new Uint8Array(parts.flatMap((part) => (typeof part === 'string' ? [...new TextEncoder().encode(part)] : part)));

const lrgb = bytes(
	head('LRGB'),
	pixels.flatMap(([x, y]) => coefficients(x, y)),
	pixels.flatMap(() => COLOUR),
);

/** What the specification says of a pixel, 0 to 255. */
function specified(light: Light, x: number, y: number): number[] {
	const [u, v] = light;
	const terms = [u * u, v * v, u * v, u, v, 1];
	const sum = coefficients(x, y).reduce(
		(total, byte, i) => total + (byte - (BIAS[i] as number)) * (SCALE[i] as number) * (terms[i] as number),
		0,
	);
	return COLOUR.map((part) => Math.min(Math.max((sum * part) / 255, 0), 255));
}

async function drop(page: Page, files: Files): Promise<void> {
	await dropFiles(page, files);
	await page.waitForTimeout(50);
	await expect.poll(() => state(page)).toBe('ready');
}

/** Pixels in the middle of the picture's quarters: lower left, lower right, upper right. */
const PLACES = [
	[1, 1],
	[6, 1],
	[6, 4],
] as const;

/** Shown and specified colours of these places. */
async function compared(page: Page, light: Light): Promise<[shown: number[], wanted: number[]][]> {
	const { width, height, data, channels } = decode(await page.screenshot());
	const box = (await page.locator('#picture').getAttribute('data-box'))?.split(',').map(Number) as number[];
	const [left = 0, top = 0, wide = 0, high = 0] = box;
	return PLACES.map(([x, y]) => {
		const column = Math.round(left + ((x + 0.5) / WIDTH) * wide);
		const row = Math.round(top + (1 - (y + 0.5) / HEIGHT) * high);
		expect(column).toBeLessThan(width);
		expect(row).toBeLessThan(height);
		const at = (row * width + column) * channels;
		return [[...data.slice(at, at + 3)], specified(light, x, y)];
	});
}

/** Where the lamp is, as the address has it. */
async function lampOf(page: Page): Promise<Light> {
	const [u = 0, v = 0, z = 0] = ((await settled(page, 'light')) ?? '').split(',').map(Number);
	const length = Math.hypot(u, v, z);
	return [u / length, v / length, z / length];
}

async function expectSpecified(page: Page, light: Light, within: number): Promise<void> {
	for (const [shown, wanted] of await compared(page, light))
		wanted.forEach((value, channel) => {
			expect(Math.abs((shown[channel] as number) - value), `${shown} for ${wanted}`).toBeLessThan(within);
		});
}

/** Grey JPEGs of pictures whose halves have these bytes. */
const jpegs = (page: Page, planes: number[][]) =>
	page.evaluate(
		async ({ planes, width, height }) => {
			const found: number[][] = [];
			for (const bytes of planes) {
				const canvas = new OffscreenCanvas(width, height);
				const texels = bytes.flatMap((byte) => [byte, byte, byte, 255]);
				canvas.getContext('2d')?.putImageData(new ImageData(new Uint8ClampedArray(texels), width, height), 0, 0);
				const blob = await canvas.convertToBlob({ type: 'image/jpeg', quality: 1 });
				found.push([...new Uint8Array(await blob.arrayBuffer())]);
			}
			return found;
		},
		{ planes, width: WIDTH, height: HEIGHT },
	);

/** The same picture as nine JPEGs: coefficient 1 is the difference to the inverse of 0, blue that to green. */
async function packed(page: Page): Promise<Uint8Array> {
	const planes = Array.from({ length: 9 }, (_, i) =>
		pixels.map(([x, y]) => (i < 6 ? coefficients(x, y)[i] : COLOUR[i - 6]) as number),
	);
	const stored = planes.map((plane, i) =>
		plane.map((byte, at) => {
			if (i === 1) return byte - (255 - (planes[0]?.[at] ?? 0)) + 128;
			return i === 8 ? byte - (planes[7]?.[at] ?? 0) + 128 : byte;
		}),
	);
	const streams = await jpegs(page, stored);
	const rows = [
		...[[100], [0, 1, 0, 0, 0, 0, 0, 0, 0], Array(9).fill(0), Array(9).fill(0)],
		...[
			[0, 1, 2, 3, 4, 5, 6, 7, 8],
			[-1, 0, -1, -1, -1, -1, -1, -1, 7],
		],
		...[streams.map(({ length }) => length), Array(9).fill(0)],
	];
	return bytes(head('JPEG_LRGB'), rows.map((row) => `${row.join(' ')}\n`).join(''), streams.flat());
}

/** The same picture as relight has it. */
function relight(): Files {
	const order = [5, 3, 4, 0, 2, 1];
	const texels = (part: (x: number, y: number) => number[]) => {
		const rows = Array.from({ length: HEIGHT }, (_, row) => HEIGHT - 1 - row);
		const data = rows.flatMap((y) => Array.from({ length: WIDTH }, (_, x) => part(x, y)).flat());
		return encode({ width: WIDTH, height: HEIGHT, channels: 3, depth: 8, data: new Uint8Array(data) });
	};
	const of = (list: number[]) => order.map((i) => list[i] as number);
	const material = { scale: [1, 1, 1, ...of(SCALE)], bias: [0, 0, 0, ...of(BIAS).map((bias) => bias / 255)] };
	const info = { type: 'ptm', colorspace: 'lrgb', nplanes: 9, format: 'png', materials: [material] };
	return {
		'info.json': new TextEncoder().encode(JSON.stringify(info)),
		'plane_0.png': texels(() => COLOUR),
		'plane_1.png': texels((x, y) => of(coefficients(x, y)).slice(0, 3)),
		'plane_2.png': texels((x, y) => of(coefficients(x, y)).slice(3)),
	};
}

test('pictures of museums show what their specification says, under a lamp that drags and keys move', async ({
	page,
}) => {
	await open(page, '?model=sphere&shells=2&still=1&ui=0&light=0,0,1&camera=0,0,1');
	await drop(page, { 'two halves.ptm': lrgb });
	await expectSpecified(page, [0, 0, 1], 3);
	await expect(page.locator('.notice')).toHaveCount(0);
	const [, , wide = 0, high = 1] = ((await page.locator('#picture').getAttribute('data-box')) ?? '')
		.split(',')
		.map(Number);
	expect(wide / high).toBeCloseTo(WIDTH / HEIGHT, 1);
	for (let i = 0; i < 8; i++) await page.keyboard.press('ArrowRight');
	for (let i = 0; i < 5; i++) await page.keyboard.press('ArrowUp');
	const lamp = await lampOf(page);
	expect(lamp[0]).toBeGreaterThan(0.3);
	expect(lamp[1]).toBeGreaterThan(0.2);
	await expectSpecified(page, lamp, 4);
	await page.locator('#picture').press('+');
	await expect
		.poll(async () => Number(((await page.locator('#picture').getAttribute('data-box')) ?? '').split(',')[2]))
		.toBeGreaterThan(wide);
	// JPEG errs by a few steps, which scales make brighter.
	await drop(page, { 'packed.ptm': await packed(page) });
	await expectSpecified(page, lamp, 10);
	await drop(page, relight());
	await expectSpecified(page, lamp, 4);
});

test('a bad picture is refused in one sentence, and the one before stays', async ({ page }) => {
	await open(page, '?model=sphere&shells=2&still=1&light=0,0,1&camera=0,0,1');
	const said = page.locator('.notice p');
	for (const [name, data, reason] of [
		['short.ptm', lrgb.slice(0, -1), 'it has fewer bytes than its header says'],
		[
			'large.ptm',
			bytes('PTM_1.2\nPTM_FORMAT_RGB\n1000000000\n1000000000\n1 1 1 1 1 1\n0 0 0 0 0 0\n'),
			'it has 1000000000 × 1000000000 pixels, more than this page opens',
		],
		['other.ptm', bytes('PTM_1.2\nPTM_FORMAT_LUM\n1\n1\n'), 'it is a PTM of another kind (PTM_1.2 LUM); expected'],
	] as const) {
		await drop(page, { [name]: data });
		await expect(said).toContainText(reason);
	}
	await drop(page, { ...relight(), 'plane_2.png': new Uint8Array([1, 2, 3]) });
	await expect(said).toContainText('plane_2.png: this plane is missing, damaged or of another size');
	const { 'plane_0.png': _, ...others } = relight();
	await drop(page, others);
	await expect(said).toContainText('plane_0.png: this plane is missing, damaged or of another size');
	await drop(page, { 'a.ptm': lrgb, 'b.ptm': lrgb });
	await expect(said).toContainText('there are several pictures in it (a.ptm, b.ptm); expected one');
});
