/** Pictures of museums: parsed, and relit by the arithmetic of the shader. */

import { describe, expect, it } from 'vitest';
import { parsePtm } from '../../web/rti/ptm.ts';
import { parseRelight } from '../../web/rti/relight.ts';
import { type Decode, type Light, type Pixels, RelitError, relitAt } from '../../web/rti/relit.ts';

const [WIDTH, HEIGHT] = [5, 4];
const SCALE = [0.5, 0.75, 0.25, 1, 0.5, 2];
const BIAS = [167, 97, 120, 128, 30, 0];
const LIGHTS: Light[] = [
	[0, 0, 1],
	[0.6, 0, 0.8],
	[-0.48, 0.6, 0.64],
];

/** Made-up bytes, the same at every run. */
const noise = (count: number, seed = 1) => {
	let state = seed;
	return Array.from({ length: count }, () => {
		state = (state * 48271) % 0x7fffffff;
		return state % 256;
	});
};
const head = (kind: string, width = WIDTH, height = HEIGHT) =>
	`PTM_1.2\nPTM_FORMAT_${kind}\n${width}\n${height}\n${SCALE.join(' ')} \n${BIAS.join(' ')} \n`;
const file = (...parts: (string | number[])[]) =>
	new Uint8Array(parts.flatMap((part) => (typeof part === 'string' ? [...new TextEncoder().encode(part)] : part)));
const none: Decode = () => Promise.reject(new Error('no picture'));
const terms = ([u, v]: Light) => [u * u, v * v, u * v, u, v, 1];
const clamp = (value: number) => Math.min(Math.max(value, 0), 1);
const dot = (bytes: readonly number[], light: Light) =>
	terms(light).reduce((sum, term, i) => sum + term * (SCALE[i] ?? 0) * ((bytes[i] ?? 0) - (BIAS[i] ?? 0)), 0) / 255;

function everywhere(check: (light: Light, x: number, y: number) => void): void {
	for (const light of LIGHTS) for (let y = 0; y < HEIGHT; y++) for (let x = 0; x < WIDTH; x++) check(light, x, y);
}

describe('a PTM', () => {
	it('of LRGB is brightness times colour, the lowest row first', async () => {
		const body = noise(WIDTH * HEIGHT * 9);
		const picture = await parsePtm(file(head('LRGB'), body), none);
		everywhere((light, x, y) => {
			const pixel = y * WIDTH + x;
			const bright = dot(body.slice(6 * pixel, 6 * pixel + 6), light);
			const colour = body.slice(WIDTH * HEIGHT * 6 + 3 * pixel).slice(0, 3);
			const wanted = colour.map((part) => clamp((bright * part) / 255));
			relitAt(picture, light, x, y).forEach((value, i) => {
				expect(value).toBeCloseTo(wanted[i] as number, 9);
			});
		});
	});

	it('of RGB has a polynomial for each channel, one after the other', async () => {
		const body = noise(WIDTH * HEIGHT * 18, 7);
		const picture = await parsePtm(file(head('RGB'), body), none);
		everywhere((light, x, y) => {
			relitAt(picture, light, x, y).forEach((value, channel) => {
				const at = 6 * (channel * WIDTH * HEIGHT + y * WIDTH + x);
				expect(value).toBeCloseTo(clamp(dot(body.slice(at, at + 6), light)), 9);
			});
		});
	});

	it('of JPEG_LRGB is put together from differences, inverted ones and side information', async () => {
		const count = WIDTH * HEIGHT;
		const grey = Array.from({ length: 9 }, (_, i) => noise(count, i + 3));
		// The decoder stands for JPEG: each stream is a byte that names its plane.
		const decode: Decode = async (blob) => {
			const [plane = 0] = new Uint8Array(await blob.arrayBuffer());
			const data = new Uint8ClampedArray((grey[plane] as number[]).flatMap((byte) => [byte, byte, byte, 255]));
			return { width: WIDTH, height: HEIGHT, data };
		};
		const side = [0, 0, 0, 7, 99, 0, 0, 255, 255, 1];
		const table = [
			[90],
			[0, 1, 0, 0, 0, 0, 0, 0, 0],
			...[Array(9).fill(0), Array(9).fill(0)],
			[1, 2, 0, 3, 4, 5, 6, 8, 7],
			[-1, 0, -1, 2, -1, -1, -1, 6, 6],
			Array(9).fill(1),
			[0, 0, 0, side.length, 0, 0, 0, 0, 0],
		];
		const streams = grey.map((_, i) => (i === 3 ? [i, ...side] : [i]));
		const stored = file(head('JPEG_LRGB'), table.map((row) => `${row.join(' ')}\n`).join(''), streams.flat());
		const picture = await parsePtm(stored, decode);
		const wrap = (value: number) => ((value % 256) + 256) % 256;
		everywhere((light, x, y) => {
			const pixel = y * WIDTH + x;
			const found = grey.map((plane) => plane[pixel] as number);
			found[1] = wrap((found[1] as number) + 255 - (found[0] as number) - 128);
			found[3] = pixel === 7 ? 99 : wrap((found[3] as number) + (found[2] as number) - 128);
			for (const plane of [7, 8]) found[plane] = wrap((found[plane] as number) + (found[6] as number) - 128);
			relitAt(picture, light, x, y).forEach((value, i) => {
				expect(value).toBeCloseTo(clamp((dot(found, light) * (found[6 + i] as number)) / 255), 9);
			});
		});
	});

	it.each([
		['no PTM', file('\u0089PNG\r\n'), 'noPtm'],
		['an empty file', file(), 'noPtm'],
		['another kind', file('PTM_1.2\nPTM_FORMAT_LUM\n1\n1\n'), 'ptmKind'],
		['another version', file('PTM_2.0\nPTM_FORMAT_RGB\n1\n1\n'), 'ptmKind'],
		['a cut header', file(head('LRGB').slice(0, 40)), 'header'],
		['a size of words', file('PTM_1.2\nPTM_FORMAT_LRGB\nwide high\n'), 'header'],
		['no pixel', file(head('LRGB', 0, 4)), 'header'],
		['10⁹ × 10⁹ pixels', file(head('LRGB', 1e9, 1e9)), 'large'],
		['missing pixels', file(head('LRGB'), noise(WIDTH * HEIGHT * 9 - 1)), 'short'],
		['missing streams', file(head('JPEG_LRGB'), `90\n${'9 '.repeat(63)}\n`), 'short'],
		['a stream that is no JPEG', file(head('JPEG_LRGB'), `90\n${'0 '.repeat(63)}\n`), 'plane'],
	])('is refused for %s', async (_, bytes, problem) => {
		const error = await parsePtm(bytes, none).catch((reason) => reason);
		expect(error).toBeInstanceOf(RelitError);
		expect(error.problem).toBe(problem);
	});
});

describe('a folder of relight', () => {
	const material = { scale: Array(9).fill(0.8), bias: Array(9).fill(0.2), range: Array(9).fill(200) };
	const info = { type: 'ptm', colorspace: 'lrgb', nplanes: 9, format: 'png', materials: [material] };
	const planes = Array.from({ length: 3 }, (_, i): Pixels => {
		const data = new Uint8ClampedArray(noise(4 * WIDTH * HEIGHT, 20 + i));
		return { width: WIDTH, height: HEIGHT, data };
	});
	const decode: Decode = async (blob) => planes[Number(await blob.text())] as Pixels;
	const beside = (name: string) => {
		const [, index] = /^plane_(\d)\.png$/.exec(name) ?? [];
		return index && Number(index) < 3 ? new Blob([index]) : undefined;
	};
	const read = (changes: object) => parseRelight(JSON.stringify({ ...info, ...changes }), beside, decode);
	/** Byte of a plane, rows from below. */
	const byte = (plane: number, x: number, y: number) =>
		(planes[Math.floor(plane / 3)]?.data[4 * ((HEIGHT - 1 - y) * WIDTH + x) + (plane % 3)] ?? 0) / 255;

	it('of a polynomial has the colour first and its own order of terms', async () => {
		const picture = await read({});
		everywhere((light, x, y) => {
			const [u, v] = light;
			const base = [1, u, v, u * u, u * v, v * v];
			const bright = base.reduce((sum, term, i) => sum + term * 0.8 * (byte(3 + i, x, y) - 0.2), 0);
			relitAt(picture, light, x, y).forEach((value, i) => {
				expect(value).toBeCloseTo(clamp(bright * byte(i, x, y)), 9);
			});
		});
	});

	it('of lamps and their own basis is mixed between them', async () => {
		const basis = noise(10 * 2 * 3, 40);
		const lights = [0, 0, 1, 0.6, 0, 0.8];
		const picture = await read({ type: 'rbf', colorspace: 'mrgb', lights, sigma: 0.5, basis });
		everywhere((light, x, y) => {
			const near = [0, 1].map((i) => {
				const square = [0, 1, 2].reduce((sum, axis) => sum + ((lights[3 * i + axis] ?? 0) - light[axis as 0]) ** 2, 0);
				return Math.exp(-square / 0.25);
			});
			const sum = (near[0] as number) + (near[1] as number);
			relitAt(picture, light, x, y).forEach((value, channel) => {
				const mixed = Array.from({ length: 10 }, (_, plane) =>
					near.reduce((total, share, lamp) => {
						const stored = basis[(plane * 2 + lamp) * 3 + channel] ?? 0;
						return total + (share / sum) * (plane === 0 ? stored / 255 : (stored - 127) / 200);
					}, 0),
				);
				const wanted = mixed
					.slice(1)
					.reduce((total, weight, p) => total + weight * 0.8 * (byte(p, x, y) - 0.2), mixed[0] ?? 0);
				expect(value).toBeCloseTo(clamp(wanted), 9);
			});
		});
	});

	it.each([
		['another kind', { type: 'neural' }, 'relightKind'],
		['a kind that is a name of every object', { type: 'constructor' }, 'relightKind'],
		['too many planes', { nplanes: 1e9 }, 'info'],
		['numbers that are none', { materials: [{ scale: 'x' }] }, 'info'],
		['no materials', { materials: undefined }, 'info'],
		[
			'a plane that is missing',
			{
				nplanes: 12,
				colorspace: 'rgb',
				type: 'hsh',
				materials: [{ scale: Array(12).fill(1), bias: Array(12).fill(0) }],
			},
			'plane',
		],
	])('is refused for %s', async (_, changes, problem) => {
		const error = await read(changes).catch((reason) => reason);
		expect(error).toBeInstanceOf(RelitError);
		expect(error.problem).toBe(problem);
	});
});
