/** Texture memory of a scene. */

import { CubeTexture, type IUniform, Material, Mesh, type Object3D, Scene, Sprite, Texture } from 'three';

interface Image {
	width?: number;
	height?: number;
	depth?: number;
	data?: ArrayBufferView | null;
}

/** Bytes of a texture with its mip levels: of its data, or else four per texel of a decoded image. */
export function bytesOf(texture: Texture): number {
	const levels = texture.mipmaps as Image[] | undefined;
	const images = levels?.length ? levels : [texture.image as Image | null];
	let bytes = 0;
	for (const image of images) {
		if (!image) continue;
		bytes += image.data?.byteLength ?? 4 * (image.width ?? 0) * (image.height ?? 0) * (image.depth ?? 1);
	}
	// A third more for mip levels that the GPU makes.
	const made = texture.generateMipmaps && images.length === 1;
	return (made ? 4 / 3 : 1) * bytes * (texture instanceof CubeTexture ? 6 : 1);
}

/** Bytes of all textures in the materials of a scene, each counted once, of invisible objects too. */
export function textureBytes(scene: Object3D): number {
	const found = new Set<Texture>();
	const note = (value: unknown) => {
		if (value instanceof Texture) found.add(value);
	};
	scene.traverse((object) => {
		if (object instanceof Scene) note(object.background);
		if (!(object instanceof Mesh || object instanceof Sprite)) return;
		for (const material of [object.material].flat()) {
			if (!(material instanceof Material)) continue;
			for (const value of Object.values(material)) note(value);
			if ('uniforms' in material)
				for (const { value } of Object.values(material.uniforms as Record<string, IUniform>)) note(value);
		}
	});
	let bytes = 0;
	for (const texture of found) bytes += bytesOf(texture);
	return bytes;
}
