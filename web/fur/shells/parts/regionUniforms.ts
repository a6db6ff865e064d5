/** Numbers of several furs on one body, as uniforms. See shaders/hair/regions/region.glsl. */

import { Color, type IUniform } from 'three';
import type { FurAsset } from '../../format.ts';
import { leanOf } from '../../light/bent.ts';

/** Hardness of borders whose cells are large on screen: hairs are of one fur or of another. */
const HARDEST = 256;

/**
 * Sets how hard borders are: 1, a mix, where cells are smaller than pixels.
 *
 * @param uniforms of a material of shells
 * @param pixels width of a tile of the coat on screen
 */
export function hardenBorders({ furCells, hardness }: Record<string, IUniform>, pixels: number): void {
	if (furCells && hardness) hardness.value = 1 / Math.min(Math.max(furCells.value / pixels - 0.5, 1 / HARDEST), 1);
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
		hardness: { value: HARDEST },
		tileWidths: { value: [1, ...regions.map(({ tile }) => tile)] },
		leans: { value: hairs.map(leanOf) },
		regionRamps: {
			value: furs.flatMap(({ ramp: { root, tip, tip2 } }) => [root, tip, tip2].map((colour) => new Color(...colour))),
		},
		regionPowers: { value: furs.map(({ ramp }) => ramp.power) },
	};
}
