import { LinearMipmapNearestFilter, SRGBColorSpace, Texture } from 'three';
import type { GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { expect, it } from 'vitest';
import { loadRoots } from '../../../../../web/fur/body/roots/Roots.ts';
import type { FurAsset } from '../../../../../web/fur/format.ts';

const asset = { roots: { texture: 0, scale: [0.25, 0.5] }, tiles: 2 } as unknown as FurAsset;

it('reads the picture of the roots in its own way, and leaves a skin that shows it alone', async () => {
	const picture = new Texture();
	const before = { ...picture };
	const parser = { json: { textures: [{}] }, getDependency: async () => picture } as unknown as GLTFParser;
	const roots = await loadRoots(parser, asset);
	expect(roots?.texture.source).toBe(picture.source);
	expect([roots?.texture.minFilter, roots?.texture.colorSpace]).toEqual([LinearMipmapNearestFilter, SRGBColorSpace]);
	expect({ ...picture }).toEqual(before);
	expect(roots?.scale.toArray()).toEqual([0.5, 1]);
});

it('says so where there is no such picture', async () => {
	const parser = { json: { textures: [] }, getDependency: async () => null } as unknown as GLTFParser;
	await expect(loadRoots(parser, asset)).rejects.toThrow('roots: texture 0 has no picture that can be read');
	expect(await loadRoots(parser, {} as FurAsset)).toBeUndefined();
});
