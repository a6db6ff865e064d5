/** Panoramas out of focus keep their light, and the ground is as bright as they are below the horizon. */

import { Color, DataTexture, DataUtils, FloatType, LightProbe, RGBAFormat, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { visitEnvironment } from '../../../web/fur/reference.ts';
import { blurred, groundAlbedo } from '../../../web/scene/panorama.ts';

const [WIDTH, HEIGHT] = [128, 64];

/** @param radiance grey, by the direction's y and its azimuth in degrees */
function panorama(radiance: (y: number, azimuth: number) => number): DataTexture {
	const texture = new DataTexture(new Float32Array(4 * WIDTH * HEIGHT), WIDTH, HEIGHT, RGBAFormat, FloatType);
	for (let row = 0; row < HEIGHT; row++)
		for (let column = 0; column < WIDTH; column++) {
			const y = Math.sin(((row + 0.5) / HEIGHT - 0.5) * Math.PI);
			const value = radiance(y, ((column + 0.5) / WIDTH - 0.5) * 360);
			(texture.image.data as Float32Array).set([value, value, value, 1], 4 * (row * WIDTH + column));
		}
	return texture;
}

/** Light of a picture, and where it is: mean direction, longer the closer it lies together. */
function light(picture: DataTexture): { sum: number; to: Vector3 } {
	let sum = 0;
	const to = new Vector3();
	visitEnvironment(picture, ({ g }, direction, solidAngle) => {
		sum += g * solidAngle;
		to.addScaledVector(direction, g * solidAngle);
	});
	return { sum, to: to.divideScalar(sum) };
}

describe('a panorama out of focus', () => {
	it('is even where the panorama is', () => {
		const { data } = blurred(
			panorama(() => 2),
			0.5,
		).image;
		const values = Array.from(data as Uint16Array, DataUtils.fromHalfFloat);
		const mean = values[0] ?? 0;
		expect(mean).toBeGreaterThan(0.1);
		expect(mean).toBeLessThan(1);
		for (const [i, value] of values.entries()) expect(value).toBeCloseTo(i % 4 === 3 ? 1 : mean, 2);
	});

	it.each([0.02, 0.7, 0.9])('spreads a lamp at a height of %d evenly, and keeps place and light', (height) => {
		const lamp = panorama((y, azimuth) => (Math.abs(y - height) < 0.03 && Math.abs(azimuth - 90) < 4 ? 4 : 0));
		const before = light(lamp);
		const after = light(blurred(lamp, 1));
		expect(after.to.angleTo(before.to)).toBeLessThan(0.03);
		expect(after.to.length()).toBeGreaterThan(0.98);
		expect(after.to.length()).toBeLessThan(before.to.length());
		const even =
			light(
				blurred(
					panorama(() => 1),
					1,
				),
			).sum /
			(4 * Math.PI);
		expect(after.sum / before.sum / even).toBeCloseTo(1, 1);
	});
});

describe('the ground of a place', () => {
	const noon = new Vector3(0, 1, 0);
	const sky = (irradiance: number) => {
		const probe = new LightProbe();
		probe.sh.coefficients[0]?.setScalar(irradiance / 0.886227);
		return probe;
	};

	it('is as bright under probe and lamp as the picture is below its horizon', () => {
		const picture = blurred(
			panorama((y) => (y < 0 ? 0.4 : 3)),
			1,
		);
		const albedo = groundAlbedo(picture, sky(1), new Color(2, 2, 2), noon);
		let [seen, weight] = [0, 0];
		visitEnvironment(picture, ({ g }, { y }, solidAngle) => {
			if (y > -0.1 || y < -0.4) return;
			seen += g * solidAngle;
			weight += solidAngle;
		});
		expect((albedo.g * 3) / Math.PI).toBeCloseTo(seen / weight, 2);
	});

	it('is neither black nor a mirror', () => {
		const dark = groundAlbedo(
			blurred(
				panorama(() => 0.001),
				1,
			),
			sky(1),
			new Color(9, 9, 9),
			noon,
		);
		expect(dark.g).toBeCloseTo(0.01);
		const bright = groundAlbedo(
			blurred(
				panorama(() => 5),
				1,
			),
			sky(0.1),
			new Color(0, 0, 0),
			noon,
		);
		expect(bright.g).toBeCloseTo(0.5);
	});
});
