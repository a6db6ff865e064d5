/** Uniforms of the law of light and eye; see eye.glsl. */

import { type IUniform, Vector4 } from 'three';
import type { FurAsset } from '../format.ts';
import { vectors } from './bent.ts';

/**
 * Surge's share of the half sphere within 90° of the eye: ∫1/(1 + |l − v|²/w²)dl over 2π.
 *
 * @param width w, radians
 */
export const surgeShare = (width: number): number => (width ** 2 / 2) * Math.log(1 + 2 / width ** 2);

/** Of each fur, three vectors for each of 1, s and s², and the surge; empty where none were baked. */
export function eyeUniforms(furs: readonly Pick<FurAsset, 'eye' | 'surge'>[]): Record<string, IUniform> {
	if (!furs[0]?.eye) return {};
	const surges = furs.map(({ surge = [0, 0, 1] }) => new Vector4(...surge, surgeShare(surge[2])));
	return {
		eye: { value: furs.flatMap(({ eye = [] }) => vectors(eye)) },
		surge: { value: surges[0] },
		surges: { value: surges },
	};
}
