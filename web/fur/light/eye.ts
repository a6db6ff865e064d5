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

/** Three vectors for each of 1, s and s², and the surge; empty where none were baked. */
export function eyeUniforms({ eye, surge = [0, 0, 1] }: Pick<FurAsset, 'eye' | 'surge'>): Record<string, IUniform> {
	if (!eye) return {};
	return { eye: { value: vectors(eye) }, surge: { value: new Vector4(...surge, surgeShare(surge[2])) } };
}
