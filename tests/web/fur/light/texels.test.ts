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

/** Σ a·φ of both texels, decoded as the shader does. */
function sums(coding: TexelCoding, phi: readonly number[]): number[] {
	const { scale, offset } = decoder(coding, CONTRAST);
	return BYTES.map((bytes) =>
		bytes.slice(0, coding.scale.length).reduce((sum, byte, i) => {
			const { plane, channel } = channelOf(i);
			const a = (byte / 255) * (scale[plane]?.getComponent(channel) ?? 0) + (offset[plane]?.getComponent(channel) ?? 0);
			return sum + a * (phi[i] as number);
		}, 0),
	);
}

/** The same of a PTM under a light from (u, v, w). */
const lights = (coding: TexelCoding, [u, v]: readonly [number, number]) => sums(coding, [u * u, v * v, u * v, u, v, 1]);

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
		const curved: TexelCoding = { ...plain, means };
		for (const way of ways) {
			const [before, after] = [lights(plain, way), lights(curved, way)];
			before.forEach((light, i) => {
				expect((after[i] as number) - 1).toBeCloseTo(CONTRAST * (light - 1), 9);
			});
		}
	});

	it('of a basis with the constant 1 do so, too; of one without they stay as they are', () => {
		const eigen = (first: number[]): TexelCoding => ({
			...plain,
			scale: scale.slice(0, 3),
			bias: bias.slice(0, 3),
			basis: { kind: 'eigen', degree: 1, matrix: [first, [0.2, 0.1, 0.9, 0.4, 0, 0.3], [0, 1, 0, 0.5, 0.2, 0]] },
		});
		const phi = [1, 0.7, -0.4];
		const [constant, other] = [
			[1, 0, 0, 0, 0, 0],
			[1, 0, 0, 0.1, 0, 0],
		].map(eigen) as [TexelCoding, TexelCoding];
		const before = sums(constant, phi);
		sums({ ...constant, means }, phi).forEach((light, i) => {
			expect(light - 1).toBeCloseTo(CONTRAST * ((before[i] as number) - 1), 9);
		});
		expect(sums({ ...other, means }, phi)).toEqual(before);
	});
});
