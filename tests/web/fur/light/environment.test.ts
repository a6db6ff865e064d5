import {
	DataTexture,
	DataUtils,
	FloatType,
	HalfFloatType,
	type LightProbe,
	RGBAFormat,
	UnsignedByteType,
	Vector3,
} from 'three';
import { describe, expect, it } from 'vitest';
import { furEnvironment, luminance, visitEnvironment } from '../../../../web/fur/light/furEnvironment.ts';

/** An equirectangular picture, rows from the nadir, of the radiance from each direction. */
function picture(radiance: (to: Vector3) => [number, number, number], width = 128, height = 64): DataTexture {
	const texels = new Float32Array(width * height * 4);
	for (let row = 0; row < height; row++)
		for (let column = 0; column < width; column++) {
			const [azimuth, elevation] = [
				((column + 0.5) / width - 0.5) * 2 * Math.PI,
				((row + 0.5) / height - 0.5) * Math.PI,
			];
			const to = new Vector3(
				Math.cos(elevation) * Math.cos(azimuth),
				Math.sin(elevation),
				Math.cos(elevation) * Math.sin(azimuth),
			);
			texels.set([...radiance(to), 1], 4 * (row * width + column));
		}
	return new DataTexture(texels, width, height, RGBAFormat, FloatType);
}

/** Harmonics of the green channel. */
const green = (probe: LightProbe) => probe.sh.coefficients.map(({ y }) => y);
const closeTo = (values: number[], digits = 3) => values.map((value) => expect.closeTo(value, digits));

/** Light from everywhere, by brightness: what a probe's constant harmonic and its lamps bring together. */
function whole({ probe, lamps }: ReturnType<typeof furEnvironment>): number {
	const [constant = new Vector3()] = probe.sh.coefficients;
	const sky = 0.2126 * constant.x + 0.7152 * constant.y + 0.0722 * constant.z;
	return sky * Math.sqrt(4 * Math.PI) + lamps.reduce((sum, { color }) => sum + luminance(color), 0);
}

const sun = new Vector3(0.48, 0.6, -0.64);
const overcast = ({ y }: Vector3) => [0.3, 0.4 + 0.1 * y, 0.5] as [number, number, number];
/** A disc of 3° in a sky that is brighter above. */
const sunny = picture((to) => (to.angleTo(sun) < (3 * Math.PI) / 180 ? [900, 800, 600] : overcast(to)), 512, 256);

describe('visitEnvironment', () => {
	it('covers the sphere once', () => {
		const mean = new Vector3();
		let sphere = 0;
		visitEnvironment(
			picture(() => [1, 1, 1]),
			(_, to, solidAngle) => {
				sphere += solidAngle;
				mean.addScaledVector(to, solidAngle);
				expect(to.length()).toBeCloseTo(1, 9);
			},
		);
		expect(sphere).toBeCloseTo(4 * Math.PI, 9);
		expect(mean.length()).toBeCloseTo(0, 9);
	});

	it.each([false, true])('reads half floats, and upside down where the texture is so: flipY %s', (flipY) => {
		// Four columns and two rows, the first of them above where it is flipped; one texel is green.
		const texels = new Uint16Array(4 * 2 * 4);
		texels[4 * (4 + 3) + 1] = DataUtils.toHalfFloat(2.5);
		const texture = new DataTexture(texels, 4, 2, RGBAFormat, HalfFloatType);
		texture.flipY = flipY;
		const lit: number[][] = [];
		visitEnvironment(texture, (radiance, to) => {
			if (radiance.g > 0) lit.push([radiance.g, ...to.toArray()]);
		});
		const level = Math.SQRT1_2 * Math.cos(Math.PI / 4);
		expect(lit).toEqual([closeTo([2.5, -level, (flipY ? -1 : 1) * Math.SQRT1_2, level], 9)]);
	});

	it('takes what is no light for darkness, and what is no number', () => {
		const texels = Float32Array.from([-3, Number.NaN, Number.POSITIVE_INFINITY, 1]);
		visitEnvironment(new DataTexture(texels, 1, 1, RGBAFormat, FloatType), (radiance) => {
			expect(radiance.toArray()).toEqual([0, 0, 65504]);
		});
	});

	it('refuses other textures in one sentence', () => {
		const bytes = new DataTexture(new Uint8Array(16), 2, 2, RGBAFormat, UnsignedByteType);
		expect(() => visitEnvironment(bytes, () => {})).toThrow(/^environment: expected an equirectangular DataTexture/);
		const few = new DataTexture(new Float32Array(12), 2, 2, RGBAFormat, FloatType);
		expect(() => visitEnvironment(few, () => {})).toThrow(/^environment: expected/);
		const unloaded = new DataTexture(null);
		Object.assign(unloaded.source, { data: null });
		expect(() => visitEnvironment(unloaded, () => {})).toThrow(/^environment: expected/);
	});
});

describe('furEnvironment', () => {
	it('of one radiance all around has one harmonic: R·√4π', () => {
		const { probe, lamps } = furEnvironment(picture(() => [1, 2, 3]));
		expect(green(probe)).toEqual(closeTo([2 * Math.sqrt(4 * Math.PI), 0, 0, 0, 0, 0, 0, 0, 0], 2));
		expect(probe.sh.coefficients[0]?.x).toBeCloseTo(Math.sqrt(4 * Math.PI), 3);
		expect(probe.sh.coefficients[0]?.z).toBeCloseTo(3 * Math.sqrt(4 * Math.PI), 3);
		expect(probe.intensity).toBe(1);
		expect(lamps).toEqual([]);
	});

	it('of a polynomial of degree 2 has exactly its harmonics', () => {
		const { PI, sqrt } = Math;
		const { probe } = furEnvironment(
			picture(({ x, y, z }) => [0, 2 + 0.5 * x - 0.25 * y + 0.125 * z + 0.3 * x * z - 0.2 * x * y + 0.1 * y * z, 0]),
			0,
		);
		const [first, second] = [sqrt((4 * PI) / 3), sqrt((4 * PI) / 15)];
		expect(green(probe)).toEqual(
			closeTo(
				[
					2 * sqrt(4 * PI),
					...[-0.25, 0.125, 0.5].map((slope) => first * slope),
					...[-0.2, 0.1, 0, 0.3, 0].map((mixed) => second * mixed),
				],
				2,
			),
		);
	});

	it('of one bright texel is Y of its direction times its light', () => {
		const texture = picture(() => [0, 0, 0], 64, 32);
		const at = 64 * 20 + 50;
		(texture.image.data as Float32Array).set([0, 7, 0, 1], 4 * at);
		const [azimuth, elevation] = [(50.5 / 64 - 0.5) * 2 * Math.PI, (20.5 / 32 - 0.5) * Math.PI];
		const to = [Math.cos(elevation) * Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation) * Math.sin(azimuth)];
		const [x = 0, y = 0, z = 0] = to;
		const light =
			((7 * 2 * Math.PI) / 64) * (Math.sin((21 / 32 - 0.5) * Math.PI) - Math.sin((20 / 32 - 0.5) * Math.PI));

		const all = furEnvironment(texture, 0);
		expect(all.lamps).toEqual([]);
		expect(green(all.probe)).toEqual(
			closeTo(
				[
					0.282095,
					...[y, z, x].map((axis) => 0.488603 * axis),
					1.092548 * x * y,
					1.092548 * y * z,
					0.315392 * (3 * z * z - 1),
					1.092548 * x * z,
					0.546274 * (x * x - y * y),
				].map((value) => value * light),
				5,
			),
		);

		const { probe, lamps } = furEnvironment(texture);
		expect(lamps).toHaveLength(1);
		expect(lamps[0]?.direction.toArray()).toEqual(closeTo(to, 6));
		expect(lamps[0]?.color.toArray()).toEqual(closeTo([0, light, 0], 6));
		expect(green(probe)).toEqual(closeTo([0, 0, 0, 0, 0, 0, 0, 0, 0], 6));
	});

	it('takes the sun out of the sky, and loses no light by it', () => {
		const [plain, split] = [furEnvironment(sunny, 0), furEnvironment(sunny)];
		const [lamp] = split.lamps;
		if (!lamp) throw new Error('no lamp');
		const degrees = (lamp.direction.angleTo(sun) * 180) / Math.PI;
		expect(degrees).toBeLessThan(0.5);
		const disc = 2 * Math.PI * (1 - Math.cos((3 * Math.PI) / 180));
		expect(lamp.color.r / (900 * disc)).toBeGreaterThan(0.98);
		expect(lamp.color.r / (900 * disc)).toBeLessThan(1.02);
		expect(Math.abs(whole(split) / whole(plain) - 1)).toBeLessThan(0.001);
		// What is left is the sky without its sun.
		const sky = furEnvironment(picture(overcast, 512, 256), 0);
		expect(green(split.probe)).toEqual(closeTo(green(sky.probe), 1));
		expect(Math.abs(whole(sky) / (whole(split) - luminance(lamp.color)) - 1)).toBeLessThan(0.01);
	});

	it('finds several lamps, the one with most light first, and no more than there are', () => {
		const second = new Vector3(-0.6, 0, 0.8);
		const texture = picture((to) => {
			if (to.angleTo(sun) < 0.1) return [50, 50, 50];
			return to.angleTo(second) < 0.1 ? [30, 30, 30] : [0.1, 0.1, 0.1];
		});
		const split = furEnvironment(texture, 5);
		const { lamps } = split;
		expect(lamps).toHaveLength(2);
		expect(lamps[0]?.direction.angleTo(sun)).toBeLessThan(0.02);
		expect(lamps[1]?.direction.angleTo(second)).toBeLessThan(0.02);
		expect(Math.abs(whole(split) / whole(furEnvironment(texture, 0)) - 1)).toBeLessThan(0.001);
	});

	it('takes no broad brightness for a lamp', () => {
		expect(furEnvironment(picture(overcast)).lamps).toEqual([]);
		expect(furEnvironment(picture(({ y }) => (y > 0 ? [1, 1, 1] : [0.1, 0.1, 0.1]))).lamps).toEqual([]);
	});
});
