import { AmbientLight, Color, DirectionalLight, Group, PointLight, Scene, SpotLight } from 'three';
import { describe, expect, it } from 'vitest';
import { sharedHue } from '../../../../web/fur/shells/hue.ts';

const of = (...lights: ConstructorParameters<typeof Color>[0][]) => {
	const scene = new Scene();
	for (const colour of lights) scene.add(new DirectionalLight(colour));
	return scene;
};
const hue = new Color();

describe('sharedHue', () => {
	it('is that of lamps of one colour, however bright and of whatever kind', () => {
		const scene = of(0xff8000, 0xff8000);
		const deep = new Group().add(new PointLight(0xff8000, 7), new SpotLight(0xff8000, 0.1));
		scene.add(deep, new AmbientLight(0x0000ff));
		expect(sharedHue(scene, hue)).toBe(true);
		expect(0.2126 * hue.r + 0.7152 * hue.g + 0.0722 * hue.b).toBeCloseTo(1, 6);
		expect(hue.g / hue.r).toBeCloseTo(new Color(0xff8000).g, 6);
		deep.add(new PointLight(0x80ff00));
		expect(sharedHue(scene, hue)).toBe(false);
	});

	it('minds no lamp that does not shine', () => {
		const scene = of(0xffffff, 0x000000);
		const off = new DirectionalLight(0xff0000, 0);
		const hidden = new DirectionalLight(0xff0000);
		hidden.visible = false;
		scene.add(off, hidden);
		expect(sharedHue(scene, hue)).toBe(true);
		expect(hue.toArray()).toEqual([1, 1, 1].map((one) => expect.closeTo(one, 6)));
		hidden.visible = true;
		expect(sharedHue(scene, hue)).toBe(false);
	});

	it('is white without lamps', () => {
		expect(sharedHue(new Scene(), hue)).toBe(true);
		expect(hue.toArray()).toEqual([1, 1, 1]);
	});
});
