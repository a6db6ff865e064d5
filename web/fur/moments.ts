/** Light → light moments: what shaders/moments.glsl computes per vertex, for one light and in double precision. */

import type { Basis } from './format.ts';

/** Directions are unit vectors to the light in the tangent frame: x along T, y along B, z along N. */
export type Direction = readonly [number, number, number];

/** β: radius of the furry body in lengths of its fur. */
export const BODY_RADIUS = 4;

/** lu^i·lv^j·lz^k for k in (0, 1), i + j + k ≤ degree (k outermost, then i, then j), then lz^½, lz^¼. */
export function smoothFunctions([u, v, z]: Direction, degree: number): number[] {
	const w = Math.max(z, 0);
	const terms: number[] = [];
	for (let k = 0; k < 2; k++)
		for (let i = 0; i + k <= degree; i++)
			for (let j = 0; i + j + k <= degree; j++) terms.push(u ** i * v ** j * w ** k);
	return [...terms, w ** 0.5, w ** 0.25];
}

/** φ(l) of a light above the horizon. */
export function evaluateBasis(basis: Basis, light: Direction): number[] {
	const [u, v] = light;
	if (basis.kind === 'ptm') return [u * u, v * v, u * v, u, v, 1];
	const terms = smoothFunctions(light, basis.degree);
	return basis.matrix.map((row) => row.reduce((sum, weight, t) => sum + weight * (terms[t] ?? 0), 0));
}

/**
 * Moments of a light of irradiance 1 from any direction, for fur at height `s` (0 at the skin, 1 at the tips).
 *
 * Below the horizon (lu, lv) stays on the unit circle and the light fades out over the dip that this height sees.
 */
export function lightMoments(basis: Basis, light: Direction, s: number): number[] {
	const [u, v, z] = light;
	if (z >= 0) return evaluateBasis(basis, light);
	const dip = Math.sqrt(1 - (BODY_RADIUS / (BODY_RADIUS + s)) ** 2);
	const fade = Math.sqrt(Math.max(1 + z / dip, 0));
	const across = Math.max(Math.hypot(u, v), 1e-4);
	return evaluateBasis(basis, [u / across, v / across, 0]).map((phi) => phi * fade);
}

/** L of a texel: its coefficients times the moments, never negative. */
export function relight(coefficients: readonly number[], moments: readonly number[]): number {
	return Math.max(
		coefficients.reduce((sum, a, i) => sum + a * (moments[i] ?? 0), 0),
		0,
	);
}
