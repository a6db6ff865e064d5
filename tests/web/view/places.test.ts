import { DataUtils, type Vector3 } from 'three';
import { expect, it } from 'vitest';
import { luminance, visitEnvironment } from '../../../web/fur/reference.ts';
import { DEFAULT_LIGHT } from '../../../web/page/light.ts';
import { environmentOf } from '../../../web/scene/environment.ts';
import { panorama } from '../../../web/view/places/pack.ts';
import { placeNamed } from '../../../web/view/places/places.ts';

it('a packed place has the light of its panorama', async () => {
	const texture = await panorama('sunset');
	let whole = 0;
	visitEnvironment(texture, (radiance, _, solidAngle) => {
		whole += luminance(radiance) * solidAngle;
	});
	const [x, , z] = DEFAULT_LIGHT;
	const wanted = environmentOf(texture, Math.atan2(z, x));
	const got = placeNamed('sunset');
	for (const [i, value] of wanted.probe.sh.toArray().entries()) expect(got.probe.sh.toArray()[i]).toBeCloseTo(value, 3);
	expect(got.key.direction?.angleTo(wanted.key.direction as Vector3)).toBeLessThan(0.001);
	expect(got.key.colour.r / wanted.key.colour.r).toBeCloseTo(1, 3);
	expect(got.others).toHaveLength(wanted.others.length);
	expect(got.ground.g / wanted.ground.g).toBeCloseTo(1, 3);

	// Its picture is as bright, in every eighth of the sphere.
	const sums = [wanted.background, got.background].map((picture) => {
		const eighths = new Float64Array(8);
		visitEnvironment(picture, (radiance, { x, y, z }, solidAngle) => {
			const eighth = (x > 0 ? 1 : 0) + (y > 0 ? 2 : 0) + (z > 0 ? 4 : 0);
			eighths[eighth] = (eighths[eighth] ?? 0) + luminance(radiance) * solidAngle;
		});
		return eighths;
	});
	sums[0]?.forEach((sum, i) => {
		expect((sums[1]?.[i] ?? 0) / sum).toBeGreaterThan(0.8);
		expect((sums[1]?.[i] ?? 0) / sum).toBeLessThan(1.25);
	});
	expect(whole).toBeGreaterThan(0);
	expect(DataUtils.fromHalfFloat(got.background.image.data?.[3] as number)).toBe(1);
});

it('a place of another name is refused with those that there are', () => {
	for (const name of ['moon', 'toString', ''])
		expect(() => placeNamed(name)).toThrow(`got ${name}, expected one of studio, city, sky, sunset, forest`);
});
