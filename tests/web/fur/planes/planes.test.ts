import { encode } from 'fast-png';
import { LinearMipmapLinearFilter, LinearMipmapNearestFilter, Texture } from 'three';
import { describe, expect, it } from 'vitest';
import {
	decodePlane,
	mipLevels,
	type PlaneBytes,
	readOneLevel,
	textureArray,
} from '../../../../web/fur/planes/planes.ts';

const noise = (length: number) => Uint8Array.from({ length }, (_, i) => (i * 7919 + (i >> 3) * 104729) % 256);

const png = (width: number, height: number, channels: number, depth: 8 | 16 = 8) => {
	const data = depth === 8 ? noise(width * height * channels) : new Uint16Array(width * height * channels);
	return encode({ width, height, channels, depth, data });
};

/** A small file that says it is a large picture. */
function enormous(): Uint8Array {
	const bytes = png(8, 16, 4);
	new DataView(bytes.buffer, bytes.byteOffset).setUint32(16, 1e9);
	return bytes;
}

describe('decodePlane', () => {
	it('keeps every byte, those of empty texels too', async () => {
		const texels = noise(8 * 16 * 4);
		for (let i = 3; i < texels.length; i += 8) texels[i] = 0;
		expect(await decodePlane('p', encode({ width: 8, height: 16, channels: 4, data: texels }), 8, 16)).toEqual(texels);
	});

	it('makes RGB opaque', async () => {
		const texels = await decodePlane('colour', png(4, 8, 3), 4, 8);
		expect([...texels.subarray(0, 8)]).toEqual([...noise(3), 255, ...noise(6).subarray(3), 255]);
	});

	it.each([
		['wrong size', png(8, 8, 4), 'plane0.png: got 8 × 8 pixels, expected 8 × 16'],
		['grey', png(8, 16, 1), 'plane0.png: got 1 channels of 8 bits, expected RGB or RGBA of 8'],
		['16 bits', png(8, 16, 4, 16), 'plane0.png: got 4 channels of 16 bits, expected RGB or RGBA of 8'],
		['no PNG', new TextEncoder().encode('hello'), /^plane0\.png: not a readable PNG/],
		['cut off', png(8, 16, 4).subarray(0, 60), /^plane0\.png: not a readable PNG/],
		['a size beyond all memory', enormous(), 'plane0.png: got 1000000000 × 16 pixels, expected 8 × 16'],
	])('refuses %s', async (_, bytes, message) => {
		await expect(decodePlane('plane0.png', bytes, 8, 16)).rejects.toThrow(message);
	});
});

/** Two planes of one layer with the given coverage; every other channel is `value` where there is coverage, else 0. */
function planesOf(alpha: number[], value: number): PlaneBytes[] {
	const plane = (channel: number) =>
		Uint8Array.from(alpha.flatMap((a) => [0, 1, 2, 3].map((c) => (c === channel ? a : a ? value : 0))));
	return [plane(-1), plane(2)];
}

describe('mipLevels', () => {
	const size = 16;
	const extent = { width: size, height: size, layers: 1 };
	const random = noise(size * size);
	const alpha = Array.from(random, (x) => (x < 64 ? 30 + x : 0)); // a quarter of the texels is covered a little

	it('go down to one texel and leave level 0 as it is', () => {
		const planes = planesOf(alpha, 200);
		const levels = mipLevels(planes, extent, 6, 0);
		expect(levels.map(([plane]) => plane?.length)).toEqual([16, 8, 4, 2, 1].map((n) => n * n * 4));
		expect(levels[0]).toEqual(planes);
	});

	it('average coefficients by coverage: empty texels do not count', () => {
		for (const [plane] of mipLevels(planesOf(alpha, 200), extent, 6, 0).slice(1, 4)) {
			const values = Array.from(plane ?? []).filter((_, i) => i % 4 === 0);
			expect(values.filter((value) => value > 0 && value < 190)).toEqual([]);
			expect(Math.max(...values)).toBe(200);
		}
	});

	it('let as much light down to every slab as level 0, though hairs stand behind each other', () => {
		const layers = 4;
		const column = Array.from(random, (x) => (x < 90 ? 2 * x : 0));
		const hairs = Array.from({ length: layers }, (_, k) => column.map((a) => Math.max(a - 25 * k, 0))).flat();
		const levels = mipLevels(planesOf(hairs, 200), { width: size, height: size, layers }, 6, 0);
		/** Mean over the texels of what comes down to the skin. */
		const through = (plane: PlaneBytes | undefined) => {
			const values = Array.from(plane ?? [])
				.filter((_, i) => i % 4 === 2)
				.map((value) => value / 255);
			const texels = values.length / layers;
			const light = Array.from({ length: texels }, (_, i) =>
				[0, 1, 2, 3].reduce((rest, k) => rest * (1 - (values[k * texels + i] ?? 0)), 1),
			);
			return light.reduce((sum, share) => sum + share, 0) / texels;
		};
		const wanted = through(levels[0]?.[1]);
		for (const [, plane] of levels.slice(1)) expect(through(plane)).toBeCloseTo(wanted, 2);
		// Mean coverages would let far less through.
		const means = [0, 1, 2, 3].map(
			(k) => hairs.slice(k * 256, (k + 1) * 256).reduce((sum, a) => sum + a / 255, 0) / 256,
		);
		expect(wanted - means.reduce((rest, mean) => rest * (1 - mean), 1)).toBeGreaterThan(0.05);
	});

	it('show what is seen: hairs in the dark below others count less', () => {
		// Two columns: an open one, and one whose lower texel lies below a thick one.
		const tops = [0, 250, 0, 250];
		const alpha = [...[128, 128, 128, 128], ...tops];
		const [plane, other] = planesOf(alpha, 0) as [PlaneBytes, PlaneBytes];
		for (let i = 0; i < 8; i++) plane[i * 4] = i % 2 ? 240 : 40;
		const [, half] = mipLevels([plane, other], { width: 2, height: 2, layers: 2 }, 6, 0);
		expect(half?.[0]?.[0]).toBeLessThan(50);
	});

	it('find coverage in the alpha of the only plane with three coefficients', () => {
		const plane = Uint8Array.from(alpha.flatMap((a) => [a ? 90 : 0, 0, 0, a]));
		const [, half] = mipLevels([plane], extent, 3, 0);
		const values = Array.from(half?.[0] ?? []).filter((_, i) => i % 4 === 0);
		expect(Math.max(...values)).toBe(90);
	});

	it('average further planes like the coefficients, and take none of them for the coverage', () => {
		const further = Uint8Array.from(alpha.flatMap((a) => (a ? [40, 128, 230, 255] : [255, 0, 255, 255])));
		for (const [coefficients, planes] of [
			[6, planesOf(alpha, 200)],
			[3, [Uint8Array.from(alpha.flatMap((a) => [90, 90, 90, a]))]],
		] as const) {
			const alone = mipLevels([...planes], extent, coefficients, 0);
			const together = mipLevels([...planes, further], extent, coefficients, 0);
			expect(together.map((level) => level.slice(0, -1))).toEqual(alone);
			const half = together[1]?.at(-1) ?? [];
			for (let i = 0; i < half.length; i += 4) {
				const covered = [0, 1, size, size + 1].some((step) => {
					const [row, column] = [Math.floor(i / 4 / (size / 2)), (i / 4) % (size / 2)];
					return alpha[row * 2 * size + column * 2 + step];
				});
				const wanted = covered ? [40, 128, 230] : [255, 0, 255];
				wanted.forEach((value, c) => {
					expect(Math.abs((half[i + c] ?? 0) - value)).toBeLessThanOrEqual(1);
				});
				expect(half[i + 3]).toBe(255);
			}
		}
	});

	it('halve width and height by themselves, down to one texel', () => {
		const alpha = noise(8 * 3);
		const planes = planesOf([...alpha], 77);
		const levels = mipLevels(planes, { width: 8, height: 3, layers: 1 }, 6, 0);
		expect(levels.map(([plane]) => (plane?.length ?? 0) / 4)).toEqual([8 * 3, 4 * 1, 2 * 1, 1]);
		const quad = [0, 1, 8, 9].reduce((sum, i) => sum + (alpha[i] ?? 0), 0) / 4;
		expect(levels[1]?.[1]?.[2]).toBe(Math.round(quad));
	});

	it('keep the mean coverage of a single slab', () => {
		const mean = (plane: PlaneBytes | undefined) => {
			const values = Array.from(plane ?? []).filter((_, i) => i % 4 === 2);
			return values.reduce((sum, value) => sum + value, 0) / values.length;
		};
		const levels = mipLevels(planesOf(alpha, 200), extent, 6, 0);
		for (const [, plane] of levels) expect(Math.abs(mean(plane) - mean(levels[0]?.[1]))).toBeLessThan(0.6);
	});

	it('never mix layers', () => {
		const first = planesOf(new Array(16).fill(255), 100);
		const second = planesOf(new Array(16).fill(255), 200);
		const both = first.map((plane, p) => Uint8Array.from([...plane, ...(second[p] as PlaneBytes)]));
		for (const [plane] of mipLevels(both, { width: 4, height: 4, layers: 2 }, 6, 0)) {
			const half = (plane?.length ?? 0) / 2;
			expect(new Set(plane?.subarray(0, half))).toEqual(new Set([100]));
			expect(new Set(plane?.subarray(half))).toEqual(new Set([200]));
		}
	});
});

describe('textureArray', () => {
	it('is unflipped, not premultiplied, and sRGB for colours only', () => {
		const extent = { width: 4, height: 4, layers: 1 };
		const mips = mipLevels(planesOf(new Array(16).fill(255), 9), extent, 6, 0).map(([plane]) => plane as PlaneBytes);
		const [data, colour] = [textureArray('a', mips, extent), textureArray('b', mips, extent, true)];
		expect([data.flipY, data.premultiplyAlpha, data.colorSpace, colour.colorSpace]).toEqual([false, false, '', 'srgb']);
		expect(data.mipmaps).toHaveLength(3);
	});
});

describe('readOneLevel', () => {
	it('leaves the plane with the coverage its mixture of levels, whichever it is', () => {
		const [two, alone] = [{ plane0: new Texture(), plane1: new Texture() }, { plane0: new Texture() }];
		for (const textures of [two, alone]) readOneLevel(textures);
		expect([two.plane0.minFilter, two.plane1.minFilter]).toEqual([LinearMipmapNearestFilter, LinearMipmapLinearFilter]);
		expect(alone.plane0.minFilter).toBe(LinearMipmapLinearFilter);
	});
});
