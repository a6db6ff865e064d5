/** Mean curves: mean brightness of a slab under a light from any direction, also below its horizon. Free of three. */

import { type Basis, type Curves, KNOTS, RADII } from '../format.ts';
import { type Direction, evaluateBasis, PolynomialFit } from './moments.ts';

/** Mean curves and the axis of their lean. */
export interface MeanCurves {
	/** Tables of the curves. */
	curves: Curves;
	/** m: unit vector along which the fur leans, tile axes u and v. */
	way: readonly [number, number];
}

/** Harmonics to order 2, real and orthonormal, in the order of the format. */
const harmonics = (x: number, y: number, z: number) => [
	0.28209479,
	0.48860251 * y,
	0.48860251 * z,
	0.48860251 * x,
	1.09254843 * x * y,
	1.09254843 * y * z,
	0.31539157 * (3 * z * z - 1),
	1.09254843 * x * z,
	0.54627422 * (x * x - y * y),
];

/** Dip of the horizon at the tips of fur on a ball: −z of the lowest visible direction. @param radius β, lengths of the fur */
export const dipOf = (radius: number): number => Math.sqrt(2 * radius + 1) / (radius + 1);

/** β clamped to the tabulated range `RADII`. */
export const heldRadius = (radius: number): number => Math.min(Math.max(radius, RADII[0]), RADII[2]);

/** Direction clamped to the horizon. */
export function heldLight([u, v, z]: Direction): Direction {
	if (z >= 0) return [u, v, z];
	const across = Math.max(Math.hypot(u, v), 1e-4);
	return [u / across, v / across, 0];
}

/** Linear between tables' knots and, in 1/(β + 1), between their radii. @param x 0..16 */
function lookUp(table: readonly (readonly number[])[], x: number, radius: number): number {
	const [b, i] = [radius < RADII[1] ? 0 : 1, Math.min(Math.floor(x), KNOTS - 2)];
	const [near, far] = [1 / (RADII[b as 0 | 1] + 1), 1 / (RADII[(b + 1) as 1 | 2] + 1)];
	const along = (knots: readonly number[] = []) => (knots[i] ?? 0) + (x - i) * ((knots[i + 1] ?? 0) - (knots[i] ?? 0));
	const [smaller, larger] = [along(table[b]), along(table[b + 1])];
	return larger + ((1 / (radius + 1) - far) / (near - far)) * (smaller - larger);
}

/**
 * b_q of a light: every curve's value, of which a slab has a weighted sum.
 *
 * @param height l·N, −1..1
 * @param lean l·m of the light clamped to the horizon
 * @param radius β of the body there
 */
export function curveValues({ even, along }: Curves, height: number, lean: number, radius: number): number[] {
	const held = heldRadius(radius);
	const x = height >= 0 ? 6 + 10 * Math.sqrt(height) : 6 * Math.max(1 + height / dipOf(held), 0);
	return even.map((table, q) => lookUp(table, x, held) + lean * lookUp(along[q] ?? [], x, held));
}

/**
 * Moments of a light of irradiance 1 from any direction for a slab.
 *
 * @param light unit vector in (T, B, N); of a fin (along the fur, across it, N)
 * @param weights of the slab, or of a fin at its height
 * @param fin whether φ takes the light along the fur, as it is laid, and along the normal
 */
export function curvedMoments(
	basis: Basis,
	{ curves, way }: MeanCurves,
	light: Direction,
	weights: readonly number[],
	radius: number,
	fin = false,
): number[] {
	const [u, v, z] = heldLight(light);
	// A fin's texels count light from both sides of the fur alike.
	const lean = fin ? u * way[1] : u * way[0] + v * way[1];
	const values = curveValues(curves, light[2], lean, radius);
	const mean = weights.reduce((sum, weight, q) => sum + weight * (values[q] ?? 0), 0);
	return evaluateBasis(basis, fin ? [u, z, v] : [u, v, z]).map((phi) => phi * mean);
}

/** Ring of directions at one height, with the solid angle of each. */
export interface Ring {
	height: number;
	share: number;
}

/** Rings from the lowest direction that tips see up to the zenith; above the horizon at the tables' knots. */
export function rings(radius: number): Ring[] {
	const [above, below] = [48, 24];
	const dip = dipOf(heldRadius(radius));
	const step = (2 * Math.PI) / SPOKES;
	return [
		...Array.from({ length: below }, (_, i) => ({ height: (-dip * (i + 0.5)) / below, share: (step * dip) / below })),
		...Array.from({ length: above }, (_, i) => {
			const root = (i + 0.5) / above;
			return { height: root * root, share: (step * 2 * root) / above };
		}),
	];
}

/** Directions of a ring: exact for curves of degree 8 with the lean and the harmonics. */
const SPOKES = 16;

/** Response of one curve to a sky. */
export interface CurveSky {
	/** A row of 9 per coefficient: harmonics of the radiance → moments, light from below the horizon included. */
	environment: number[][];
	/** b_q·φ above the horizon as polynomials of degree 2, nine numbers per coefficient: see `PolynomialFit`. */
	polynomials: number[][];
}

/** Per ring: ∫φ·Y_j, a row of 9 per coefficient, and polynomials of φ; without the curve, and times l·m. */
export type RingParts = { harmonics: Float64Array; fit: PolynomialFit }[];

function ringParts(basis: Basis, way: MeanCurves['way'], { height, share }: Ring, fin: boolean): RingParts {
	const count = coefficientsOf(basis);
	const parts = [0, 1].map(() => ({ harmonics: new Float64Array(9 * count), fit: new PolynomialFit(count) }));
	for (let spoke = 0; spoke < SPOKES; spoke++) {
		const [level, azimuth] = [Math.sqrt(1 - height * height), (2 * Math.PI * spoke) / SPOKES];
		const light: Direction = [level * Math.cos(azimuth), level * Math.sin(azimuth), height];
		const [u, v, z] = light;
		const [hu, hv, hz] = heldLight(light);
		const phi = evaluateBasis(basis, fin ? [hu, hz, hv] : [hu, hv, hz]);
		const y = fin ? harmonics(u, z, v) : harmonics(u, v, z);
		const lean = fin ? hu * way[1] : hu * way[0] + hv * way[1];
		for (const [p, part] of parts.entries()) {
			const strength = share * (p === 0 ? 1 : lean);
			for (let c = 0; c < count; c++)
				for (let j = 0; j < 9; j++)
					part.harmonics[9 * c + j] =
						(part.harmonics[9 * c + j] as number) + strength * (phi[c] as number) * (y[j] as number);
			if (z >= 0) part.fit.add(light, phi, strength / (2 * Math.PI));
		}
	}
	return parts;
}

const coefficientsOf = (basis: Basis) => (basis.kind === 'ptm' ? 6 : basis.matrix.length);

/**
 * ∫b_q(ω)·φ(ω)·Y_j(ω)dω over all directions that tips see, and polynomials for light on bent hairs; one entry per curve.
 * A slab's response is their weighted sum.
 *
 * @param radius β of the body
 * @param fin as in `curvedMoments`; harmonics are then in (along the fur, N, across it)
 * @param known cache of rings by height: above the horizon they are the same for all radii
 */
export function curveSkies(
	basis: Basis,
	{ curves, way }: MeanCurves,
	radius: number,
	fin = false,
	known = new Map<number, RingParts>(),
): CurveSky[] {
	const count = coefficientsOf(basis);
	const sums = curves.even.map(() => new Float64Array(9 * count));
	const fits = curves.even.map(() => new PolynomialFit(count));
	for (const ring of rings(radius)) {
		const { height } = ring;
		const parts = known.get(height) ?? ringParts(basis, way, ring, fin);
		if (height >= 0) known.set(height, parts);
		const even = curveValues(curves, height, 0, radius);
		const lean = curveValues(curves, height, 1, radius);
		for (const [q, sum] of sums.entries()) {
			for (const [p, part] of parts.entries()) {
				const factor = p === 0 ? (even[q] as number) : (lean[q] as number) - (even[q] as number);
				for (let i = 0; i < sum.length; i++) sum[i] = (sum[i] as number) + factor * (part.harmonics[i] as number);
				fits[q]?.addAll(part.fit, factor);
			}
		}
	}
	return sums.map((sum, q) => ({
		environment: Array.from({ length: count }, (_, c) => [...sum.subarray(9 * c, 9 * c + 9)]),
		polynomials: fits[q]?.rows(fin) ?? [],
	}));
}
