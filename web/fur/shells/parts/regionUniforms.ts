/** Numbers of several furs on one body, as uniforms. See shaders/hair/regions/region.glsl. */

import { Color, type IUniform } from 'three';
import type { FurAsset } from '../../format.ts';
import { leanOf } from '../../light/bent.ts';

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
		tileWidths: { value: [1, ...regions.map(({ tile }) => tile)] },
		leans: { value: hairs.map(leanOf) },
		regionRamps: {
			value: furs.flatMap(({ ramp: { root, tip, tip2 } }) => [root, tip, tip2].map((colour) => new Color(...colour))),
		},
		regionPowers: { value: furs.map(({ ramp }) => ramp.power) },
	};
}
