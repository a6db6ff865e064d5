import { deflateSync } from 'node:zlib';
import { decode, encode } from 'fast-png';
import { zlibSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { decodePlane } from '../../../../web/fur/planes/planes.ts';
import { isWholePng } from '../../../../web/fur/planes/png.ts';
import { sparse } from '../../deflated.ts';

/** An RGBA picture with these IDAT chunks; without checksums. */
function png(width: number, height: number, ...data: Uint8Array[]): Uint8Array {
	const head = encode({ width: 1, height: 1, channels: 4, data: new Uint8Array(4) }).slice(0, 33);
	const view = new DataView(head.buffer);
	view.setUint32(16, width);
	view.setUint32(20, height);
	const chunks = [...data.map((data) => ({ type: 'IDAT', data })), { type: 'IEND', data: new Uint8Array() }];
	const parts = chunks.map(({ type, data }) => {
		const chunk = new Uint8Array(12 + data.length);
		new DataView(chunk.buffer).setUint32(0, data.length);
		chunk.set(new TextEncoder().encode(type), 4);
		chunk.set(data, 8);
		return chunk;
	});
	return new Uint8Array(Buffer.concat([head, ...parts]));
}

/** Rows of zeros and ones without filters, each after its byte 0. */
function rows(width: number, height: number): { raw: Uint8Array; texels: Uint8Array } {
	const texels = sparse(width * height * 4);
	const raw = new Uint8Array(height * (width * 4 + 1));
	for (let y = 0; y < height; y++)
		raw.set(texels.subarray(y * width * 4, (y + 1) * width * 4), y * (width * 4 + 1) + 1);
	return { raw, texels };
}

/** Bytes of an interlaced picture: texels of the seven pictures, and a byte per row of each. */
const interlacedSize = (width: number, height: number, channels: number) =>
	['00', '40', '04', '20', '02', '10', '01'].reduce((sum, first, i) => {
		const [x, y] = [Number(first[0]), Number(first[1])];
		const columns = Math.ceil((width - x) / ([8, 8, 4, 4, 2, 2, 1][i] as number));
		const rows = Math.ceil((height - y) / ([8, 8, 8, 4, 4, 2, 2][i] as number));
		return sum + (columns > 0 && rows > 0 ? rows * (1 + columns * channels) : 0);
	}, 0);

const message = async (bytes: Uint8Array, width: number, height: number) => {
	try {
		await decodePlane('plane0.png', bytes, width, height);
		return 'decoded';
	} catch (error) {
		return (error as Error).message;
	}
};

describe('a plane', () => {
	it.each([
		['one chunk', (data: Uint8Array) => [data]],
		['two chunks', (data: Uint8Array) => [data.subarray(0, 4000), data.subarray(4000)]],
	])('keeps every byte in %s', async (_, cut) => {
		const { raw, texels } = rows(256, 391);
		const got = await decodePlane('plane0.png', png(256, 391, ...cut(deflateSync(raw))), 256, 391);
		expect(Buffer.compare(got, texels)).toBe(0);
	});

	it('that unpacks to more than its size is refused when it does', async () => {
		const bomb = deflateSync(new Uint8Array(20e6));
		expect(await message(png(8, 16, bomb), 8, 16)).toBe(
			'plane0.png: not a readable PNG (it unpacks to more than the 528 bytes of its size)',
		);
	});

	it.each([
		['a wrong checksum', (data: Uint8Array) => data.fill(0, data.length - 4)],
		['its last bytes missing', (data: Uint8Array) => data.subarray(0, -9)],
		['no deflated data', (data: Uint8Array) => data.fill(7)],
	])('with %s is refused', async (_, broken) => {
		const { raw } = rows(8, 16);
		expect(await message(png(8, 16, broken(Uint8Array.from(deflateSync(raw)))), 8, 16)).toMatch(
			/^plane0\.png: not a readable PNG \(.+\)$/,
		);
	});

	it('that unpacks to less is refused', async () => {
		const { raw } = rows(8, 16);
		expect(await message(png(8, 16, zlibSync(raw.subarray(0, 500))), 8, 16)).toBe(
			'plane0.png: not a readable PNG (got 500 bytes of data, expected 528)',
		);
	});

	it.each<[string, 0 | 1, number, number, number]>([
		['as it is', 0, 3, 11, 7],
		['interlaced', 1, 4, 13, 22],
		['interlaced', 1, 3, 3, 2],
	])('has the pixels that fast-png finds under all filters, %s', async (_, interlaced, channels, width, height) => {
		// Bytes of 0 to 4, so that any of them may be a filter.
		const raw = Uint8Array.from({ length: 4 * (width * channels + 8) * height }, (_, i) => (i * i + (i >> 2)) % 5);
		const size = interlaced ? interlacedSize(width, height, channels) : height * (1 + width * channels);
		const picture = png(width, height, zlibSync(raw.subarray(0, size)));
		picture[25] = channels === 4 ? 6 : 2;
		picture[28] = interlaced;
		const { data } = decode(picture);
		const got = await decodePlane('plane0.png', picture, width, height);
		expect(got.filter((_, i) => channels === 4 || i % 4 < 3)).toEqual(data);
		expect(new Set(data).size).toBeGreaterThan(3);
	});

	it('with a filter that no PNG has is refused', async () => {
		expect(await message(png(1, 1, zlibSync(Uint8Array.of(5, 1, 2, 3, 4))), 1, 1)).toBe(
			'plane0.png: not a readable PNG (got filter 5, expected 0 to 4)',
		);
	});
});

it('a PNG is whole with its end', () => {
	const picture = png(8, 16, zlibSync(rows(8, 16).raw));
	expect(isWholePng(picture)).toBe(true);
	for (let length = 0; length < picture.length; length++) expect(isWholePng(picture.subarray(0, length))).toBe(false);
	expect(isWholePng(new TextEncoder().encode('a page that says sorry, and no picture at all'))).toBe(true);
});
