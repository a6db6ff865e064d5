/** Numbers of several furs on one body, as uniforms. See shaders/hair/regions/region.glsl. */

import { Color, type IUniform, type ShaderMaterial } from 'three';
import type { FurAsset } from '../../format.ts';
import { leanOf } from '../../light/bent.ts';

/** Hardness of borders whose cells are large on screen: hairs are of one fur or of another. */
const HARDEST = 256;

/**
 * Sets how hard borders are: 1, a mix, where cells are smaller than pixels.
 *
 * @param material of shells
 * @param texel width of a texel of the coat on screen, pixels
 */
export function harden({ uniforms: { cellTexels, hardness } }: ShaderMaterial, texel: number): void {
	if (cellTexels && hardness)
		hardness.value = 1 / Math.min(Math.max(1 / (cellTexels.value * texel) - 0.5, 1 / HARDEST), 1);
}

/**
 * Numbers of each fur that the shaders look up, the coat first.
 *
 * @param hairs furs with numbers of their own, the coat first; see `hairsOf`
 */
export function regionUniforms(
	{ cells, furs: regions }: NonNullable<FurAsset['regions']>,
	hairs: readonly FurAsset[],
	furs: readonly FurAsset[],
): Record<string, IUniform> {
	return {
		furCells: { value: cells },
		cellTexels: { value: (hairs[0] as FurAsset).size / cells }, // for `harden`
		hardness: { value: HARDEST },
		tileWidths: { value: [1, ...regions.map(({ tile }) => tile)] },
		leans: { value: hairs.map(leanOf) },
		regionRamps: {
			value: furs.flatMap(({ ramp: { root, tip, tip2 } }) => [root, tip, tip2].map((colour) => new Color(...colour))),
		},
		regionPowers: { value: furs.map(({ ramp }) => ramp.power) },
	};
}
