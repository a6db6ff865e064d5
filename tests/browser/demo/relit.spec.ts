import type { Page } from '@playwright/test';
import { decode } from 'fast-png';
import { expect, open, state, test } from '../harness.ts';

test.use({ viewport: { width: 200, height: 150 } });

type Files = Record<string, Uint8Array>;
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
	const parts = Object.entries(files).map(([name, data]) => [name, Buffer.from(data).toString('base64')] as const);
	await page.evaluate((parts) => {
		const transfer = new DataTransfer();
		for (const [name, base64] of parts)
			transfer.items.add(new File([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))], name));
		const event = new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: transfer });
		document.getElementById('picture')?.dispatchEvent(event);
	}, parts);
	await page.waitForTimeout(50);
	await expect.poll(() => state(page), { timeout: 60_000 }).toBe('ready');
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

const LIGHTS: Light[] = [
	[0, 0, 1],
	[0.6, 0, 0.8],
	[-0.48, 0.6, 0.64],
];

for (const light of LIGHTS)
	test(`a dropped .ptm shows what its specification says under the lamp at ${light}`, async ({ page }) => {
		await open(page, `?model=sphere&shells=2&still=1&ui=0&light=${light}&camera=0,0,1`);
		await drop(page, { 'two halves.ptm': lrgb });
		for (const [shown, wanted] of await compared(page, light))
			wanted.forEach((value, channel) => {
				expect(Math.abs((shown[channel] as number) - value), `${shown} for ${wanted}`).toBeLessThan(3);
			});
	});
