import { describe, expect, it } from 'vitest';
import { channelOf } from '../../../../web/fur/format.ts';
import { CONTRAST, decoder, type TexelCoding } from '../../../../web/fur/light/texels.ts';

const BYTES = [
	[12, 200, 90, 140, 77, 230],
	[255, 0, 31, 8, 190, 64],
];

const scale = [0.01, 0.02, 0.015, 0.01, 0.03, 0.008];
const bias = [100, 90, 120, 80, 128, 10];
const means = {
	curves: { even: [], along: [] },
	way: [0, 1] as const,
	weights: [],
};

/** Light of both texels from (u, v, w), decoded as the shader does. */
function lights(coding: TexelCoding, [u, v]: readonly [number, number]): number[] {
	const { scale, offset } = decoder(coding, CONTRAST);
	const phi = [u * u, v * v, u * v, u, v, 1];
	return BYTES.map((bytes) =>
		bytes.slice(0, coding.scale.length).reduce((sum, byte, i) => {
			const { plane, channel } = channelOf(i);
			const a = (byte / 255) * (scale[plane]?.getComponent(channel) ?? 0) + (offset[plane]?.getComponent(channel) ?? 0);
			return sum + a * (phi[i] as number);
		}, 0),
	);
}

describe('texels', () => {
	const plain: TexelCoding = { scale, bias, basis: { kind: 'ptm' } };
	const ways = [
		[0, 0],
		[0.6, -0.3],
		[-0.2, 0.9],
	] as const;

	it('are decoded by λ(byte − Ω)', () => {
		const phi = [0.36, 0.09, -0.18, 0.6, -0.3, 1];
		const wanted = BYTES.map((bytes) =>
			bytes.reduce((sum, byte, i) => sum + (scale[i] as number) * (byte - (bias[i] as number)) * (phi[i] as number), 0),
		);
		lights(plain, [0.6, -0.3]).forEach((light, i) => {
			expect(light).toBeCloseTo(wanted[i] as number, 9);
		});
	});

	it('that are times a mean curve differ more from it, equally under every light', () => {
		const curved: TexelCoding = { ...plain, means: means };
		for (const way of ways) {
			const [before, after] = [lights(plain, way), lights(curved, way)];
			before.forEach((light, i) => {
				expect((after[i] as number) - 1).toBeCloseTo(CONTRAST * (light - 1), 9);
			});
		}
	});

	it('of three numbers, or of a basis without a constant, stay as they are', () => {
		const three: TexelCoding = {
			...plain,
			scale: scale.slice(0, 3),
			bias: bias.slice(0, 3),
		};
		const eigen: TexelCoding = {
			...plain,
			basis: { kind: 'eigen', degree: 1, matrix: [] },
		};
		for (const coding of [three, eigen])
			expect(lights({ ...coding, means: means }, [0.6, -0.3])).toEqual(lights(coding, [0.6, -0.3]));
	});
});
