/** Light of a place in units of the page: a dark one has the fill light of a studio, others keep theirs. */

import { Color, DataTexture, FloatType, RGBAFormat } from 'three';
import { describe, expect, it } from 'vitest';
import { luminance, visitEnvironment } from '../../../web/fur/reference.ts';
import { type Environment, environmentOf } from '../../../web/scene/environment.ts';

/** A lamp half way up among walls. @param walls their radiance; the lamp has 400 */
function place(walls: number): DataTexture {
	const [width, height] = [128, 64];
	const texture = new DataTexture(
		new Float32Array(4 * width * height).fill(walls),
		width,
		height,
		RGBAFormat,
		FloatType,
	);
	let at = 0;
	visitEnvironment(texture, (_, to) => {
		if (to.x > 0.68 && to.y > 0.68) (texture.image.data as Float32Array).fill(400, at, at + 4);
		at += 4;
	});
	return texture;
}

/** Light of the walls and of the lamps. */
function parts({ probe, key, others }: Environment): [walls: number, lamps: number] {
	const mean = probe.sh.coefficients[0]?.toArray() ?? [];
	const lamps = [key.colour, ...others.map(({ color }) => color)].map(luminance);
	return [luminance(new Color(...mean)) * Math.sqrt(4 * Math.PI), lamps.reduce((sum, lamp) => sum + lamp)];
}

describe('light of a place', () => {
	it('has fill light where the walls are dark, and is as bright as others', () => {
		const [dark, key] = parts(environmentOf(place(0.01), 0));
		const [grey, sun] = parts(environmentOf(place(2), 0));
		expect(dark / key).toBeCloseTo(0.24 / 0.76, 2);
		expect(grey / sun).toBeGreaterThan(0.5);
		expect(dark + key).toBeCloseTo(9.75, 1);
		expect(grey + sun).toBeCloseTo(9.75, 1);
	});
});
