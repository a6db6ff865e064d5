import { DataArrayTexture, DataTexture, Mesh, MeshBasicMaterial, PlaneGeometry, Scene, Texture } from 'three';
import { describe, expect, it } from 'vitest';
import { bytesOf, textureBytes } from '../../../../web/demo/stage/memory.ts';

describe('the bytes of a texture', () => {
	it('are those of its data, of all its levels', () => {
		const array = new DataArrayTexture(new Uint8Array(8 * 8 * 4 * 3), 8, 8, 3);
		expect(bytesOf(array)).toBe(768);
		array.mipmaps = [8, 4, 2].map((size) => ({
			data: new Uint8Array(size * size * 4 * 3),
			width: size,
			height: size,
		})) as never;
		expect(bytesOf(array)).toBe(4 * 3 * (64 + 16 + 4));
	});

	it('are four a texel where the browser has decoded a picture, and a third more for its levels', () => {
		const texture = new Texture({ width: 30, height: 10 } as HTMLImageElement);
		expect(bytesOf(texture)).toBeCloseTo((4 / 3) * 1200, 6);
		expect(bytesOf(new Texture())).toBe(0);
	});
});

it('a scene counts each texture once', () => {
	const map = new DataTexture(new Uint8Array(400), 10, 10);
	const scene = new Scene();
	scene.background = new DataTexture(new Uint8Array(40), 5, 2);
	for (let i = 0; i < 2; i++) scene.add(new Mesh(new PlaneGeometry(), new MeshBasicMaterial({ map })));
	expect(textureBytes(scene)).toBe(440);
});
