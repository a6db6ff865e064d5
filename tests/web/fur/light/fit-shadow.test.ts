import { type DirectionalLight, PointLight, Sphere, SpotLight } from 'three';
import { expect, it } from 'vitest';
import { fitFurShadow } from '../../../../web/fur/index.ts';

it.each([new PointLight(), new SpotLight()])('fits the shadow of directional lamps alone', (light) => {
	expect(() => fitFurShadow(light as unknown as DirectionalLight, new Sphere(), 0.1)).toThrow(
		'fitFurShadow: got another light, expected a DirectionalLight',
	);
	expect(light.castShadow).toBe(false);
});
