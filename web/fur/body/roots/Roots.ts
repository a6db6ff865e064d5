/** Colours of the skin at the roots of the hairs, from the model's own picture. */

import { LinearMipmapNearestFilter, SRGBColorSpace, type Texture, Vector2 } from 'three';
import type { GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { FUR_EXTENSION, type FurAsset } from '../../format.ts';

/** A picture that is laid out as the shells' texture coordinates are. */
export interface Roots {
	texture: Texture;
	/** Coordinates of the picture per texture coordinate of the shells. */
	scale: Vector2;
}

/**
 * Loads the picture of an asset.
 *
 * @throws Error where it cannot be read
 */
export async function loadRoots(parser: GLTFParser, { roots, tiles = 1 }: FurAsset): Promise<Roots | undefined> {
	if (!roots) return undefined;
	const { texture: index, scale } = roots;
	const loaded: Texture | null = parser.json.textures?.[index] && (await parser.getDependency('texture', index));
	if (!loaded) throw new Error(`${FUR_EXTENSION}/roots: texture ${index} has no picture that can be read`);
	// The skin may show the same picture.
	const texture = loaded.clone();
	texture.colorSpace = SRGBColorSpace;
	// Hairs hide where the level changes; between two levels every fragment would decode eight texels.
	texture.minFilter = LinearMipmapNearestFilter;
	return { texture, scale: new Vector2(...scale).multiplyScalar(tiles) };
}

/** @param asset the fur's, whose tiles may be another's than the body's */
export function rootUniforms({ texture, scale }: Roots, { tiles = 1 }: FurAsset) {
	return { roots: { value: texture }, rootsUnit: { value: scale.clone().divideScalar(tiles) } };
}
