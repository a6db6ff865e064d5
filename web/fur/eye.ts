/** The law of light and eye, as eye.glsl has it: its numbers. */

import { type IUniform, Vector3 } from 'three';
import { vectors } from './bent.ts';
import type { FurAsset } from './format.ts';

/** Three vectors for each of 1, s and s², and the surge; nothing where no numbers were baked. */
export function eyeUniforms({ eye, surge = [0, 0, 1] }: Pick<FurAsset, 'eye' | 'surge'>): Record<string, IUniform> {
	return eye ? { eye: { value: vectors(eye) }, surge: { value: new Vector3(...surge) } } : {};
}
