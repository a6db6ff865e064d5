/** Whole square of fur as six numbers: its look from straight above is as linear in the light as each texel. */

import type { CompressedArrayTexture, Texture } from 'three';
import type { Fur } from '../../fur/index.ts';
import { alphaChannel, channelOf, evaluateBasis } from '../../fur/reference.ts';

/** Places of the six coefficients, and of α. */
const SLOTS = [0, 1, 2, 3, 4, 5].map(channelOf);
const ALPHA = alphaChannel(6);

/**
 * Mean over the tile of Σ_k α_k·Π_{j>k}(1 − α_j)·a_k: coefficients of the fur seen from above, in colours of its own hairs.
 *
 * @param fur with six coefficients
 */
export function seenFromAbove({ asset, textures }: Pick<Fur, 'asset' | 'textures'>): number[] {
	const { size, layers, pelts } = asset;
	const pelt = pelts[0];
	if (!pelt || asset.coefficients !== 6) throw new Error('expected a pelt of six coefficients');
	const planes = [bytesOf(textures.plane0), bytesOf(textures.plane1)];
	const texels = size * size;
	const sums = new Float64Array(6);
	for (let t = 0; t < texels; t++) {
		let left = 1;
		for (let k = layers - 1; k >= 0 && left > 0; k--) {
			const at = 4 * (k * texels + t);
			const alpha = (planes[ALPHA.plane]?.[at + ALPHA.channel] ?? 0) / 255;
			for (const [i, { plane, channel }] of SLOTS.entries())
				sums[i] = (sums[i] ?? 0) + left * alpha * (planes[plane]?.[at + channel] ?? 0);
			left *= 1 - alpha;
		}
	}
	// Ω is subtracted once, times the visible coverage.
	const seen = coverage(asset, planes[1] as Uint8Array);
	return Array.from(sums, (sum, i) => (pelt.scale[i] ?? 0) * (sum / texels - seen * (pelt.bias[i] ?? 0)));
}

/** Mean share of the ground hidden by hair. */
function coverage({ size, layers }: Fur['asset'], plane1: Uint8Array): number {
	const texels = size * size;
	let open = 0;
	for (let t = 0; t < texels; t++) {
		let left = 1;
		for (let k = 0; k < layers; k++) left *= 1 - (plane1[4 * (k * texels + t) + ALPHA.channel] ?? 0) / 255;
		open += left;
	}
	return 1 - open / texels;
}

/** Stored bytes of a plane, layer after layer, the lowest first; without mip levels. */
export function bytesOf(texture: Texture | undefined): Uint8Array {
	const levels = (texture as CompressedArrayTexture | undefined)?.mipmaps;
	return (levels?.[0]?.data as Uint8Array | undefined) ?? new Uint8Array();
}

/** L of six coefficients under a light. @param light unit vector to it: x along u, y along v, z up */
export function lit(coefficients: readonly number[], light: readonly [number, number, number]): number {
	const phi = evaluateBasis({ kind: 'ptm' }, light);
	return coefficients.reduce((sum, a, i) => sum + a * (phi[i] ?? 0), 0);
}

/** From world axes (y up, u along x, v against z) to the tile's. */
export function onTile({ x, y, z }: { x: number; y: number; z: number }): [number, number, number] {
	return [x, -z, y];
}
