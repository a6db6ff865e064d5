/** Uniforms of the law of light and eye; see eye.glsl. */

import { type IUniform, Vector4 } from 'three';
import type { FurAsset } from '../format.ts';
import { vectors } from './bent.ts';

/** Terms of the law. */
const TERMS = 16;

/**
 * Surge's share of the half sphere within 90° of the eye: ∫1/(1 + |l − v|²/w²)dl over 2π.
 *
 * @param width w, radians
 */
export const surgeShare = (width: number): number => (width ** 2 / 2) * Math.log(1 + 2 / width ** 2);

/** Rows of sixteen numbers as vectors; missing ones are 0. */
const terms = (rows: readonly (readonly number[])[]): Vector4[] =>
	vectors(rows.map((row) => Array.from({ length: TERMS }, (_, i) => row[i] ?? 0)));

/** Vectors of each fur, four for each of 1, s and s², of its fins, and the surge; empty where none were baked. */
export function eyeUniforms(furs: readonly Pick<FurAsset, 'eye' | 'finEye' | 'surge'>[]): Record<string, IUniform> {
	if (!furs[0]?.eye) return {};
	const surges = furs.map(({ surge = [0, 0, 1] }) => new Vector4(...surge, surgeShare(surge[2])));
	return {
		eye: { value: furs.flatMap(({ eye = [] }) => terms(eye)) },
		...(furs[0].finEye && { finEye: { value: furs.flatMap(({ finEye = [] }) => terms(finEye)) } }),
		surge: { value: surges[0] },
		surges: { value: surges },
	};
}
