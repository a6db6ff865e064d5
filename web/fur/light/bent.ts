/** Uniforms of the law of light on bent hairs; see bent.glsl. */

import { Vector2, Vector4 } from 'three';
import type { FurAsset } from '../format.ts';

/** Mean displacement of the tips inside the tile, share of the length. */
export function leanOf({ drift, height }: Pick<FurAsset, 'drift' | 'height'>): Vector2 {
	return new Vector2(...(drift.at(-1) ?? [0, 0])).divideScalar(height);
}

/** m: unit vector along the fur's lean, tile axes. */
export function wayOf({ drift }: Pick<FurAsset, 'drift'>): [number, number] {
	const [u, v] = drift.at(-1) ?? [0, 0];
	const length = Math.hypot(u, v);
	return length > 0 ? [u / length, v / length] : [0, 1];
}

/** Weights of eight terms, two vectors for each of 1, s and s²: as baked, or defaults for any fur. */
export function bentWeights(asset: Pick<FurAsset, 'drift' | 'height' | 'bent'>): Vector4[] {
	const rows = asset.bent ?? [
		[0, -0.5 * leanOf(asset).length(), 0, 0, 0, 0, 0, 0],
		[-1.8, 0, 2.7, -1.5, 0, 0, 0, 0],
		[0, 0, 0, 0, 0, 0, 0, 0],
	];
	return vectors(rows);
}

/** Rows of numbers, four to a vector. */
export const vectors = (rows: readonly (readonly number[])[]): Vector4[] =>
	rows.flatMap((row) => Array.from({ length: row.length / 4 }, (_, i) => new Vector4().fromArray(row, 4 * i)));
