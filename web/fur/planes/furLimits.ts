/** Texture limits of a GPU, and the check of an asset against them. */

import { FUR_EXTENSION, type FurAsset } from '../format.ts';

/** Largest textures of a GPU. */
export interface FurLimits {
	/** Texels per side. */
	size: number;
	/** Layers of a texture array. */
	layers: number;
}

/** Limits of the GPU behind a context. */
export function furLimits(gl: WebGLRenderingContext | WebGL2RenderingContext): FurLimits {
	const { MAX_TEXTURE_SIZE, MAX_ARRAY_TEXTURE_LAYERS } = gl as WebGL2RenderingContext;
	return { size: gl.getParameter(MAX_TEXTURE_SIZE), layers: gl.getParameter(MAX_ARRAY_TEXTURE_LAYERS) };
}

/**
 * Refuses an asset that is too large.
 *
 * @throws Error where the asset's planes do not fit into this GPU's textures
 */
export function checkLimits({ size, layers: each, fins, pelts, regions }: FurAsset, limits: FurLimits): void {
	const layers = each * (1 + (regions?.furs.length ?? 0));
	const expected = `expected at most ${limits.size} × ${limits.size} on this GPU`;
	if (size > limits.size) throw new Error(`${FUR_EXTENSION}/size: got tiles of ${size} × ${size} texels, ${expected}`);
	if (layers > limits.layers)
		throw new Error(`${FUR_EXTENSION}/layers: got ${layers} layers, expected at most ${limits.layers} on this GPU`);
	for (const { fin } of fins === undefined ? [] : pelts) {
		if (fin && Math.max(fin.width, fin.height) > limits.size)
			throw new Error(`${FUR_EXTENSION}/pelts/fin: got ${fin.width} × ${fin.height} texels, ${expected}`);
	}
}
