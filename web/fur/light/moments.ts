/** Light moments of one light in double precision; the reference for shaders/light/moments.glsl. */

import type { Basis } from '../format.ts';

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

/**
 * GLSL: the smooth functions of u, v, w, root = √w and root4 = ∜w, each times its weights, by Horner's scheme; a vec3.
 * Weights are literals: as uniforms they cost software rasterisers more than the rest of a vertex.
 *
 * @param rows weights for each of the three parts; an absent one is 0
 */
export function smoothSum(degree: number, rows: readonly (readonly number[] | undefined)[]): string {
	let next = 0;
	const weight = (t: number) => `vec3(${rows.map((row) => (row?.[t] ?? 0).toExponential(7)).join(', ')})`;
	const horner = (parts: string[], x: string) => parts.reduceRight((rest, part) => `${part} + ${x} * (${rest})`);
	const polynomial = (top: number) => {
		const rows = Array.from({ length: top + 1 }, (_, i) =>
			horner(
				Array.from({ length: top + 1 - i }, () => weight(next++)),
				'v',
			),
		);
		return horner(rows, 'u');
	};
	const [flat, risen] = [polynomial(degree), polynomial(degree - 1)];
	return `(${flat} + w * (${risen}) + root * ${weight(next)} + root4 * ${weight(next + 1)})`;
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
 * Below the horizon (lu, lv) stays on the unit circle and the light fades out over the dip at this height.
 */
export function lightMoments(basis: Basis, light: Direction, s: number): number[] {
	const [u, v, z] = light;
	if (z >= 0) return evaluateBasis(basis, light);
	const fade = Math.sqrt(Math.max(1 + z / horizonDip(s), 0));
	const across = Math.max(Math.hypot(u, v), 1e-4);
	return evaluateBasis(basis, [u / across, v / across, 0]).map((phi) => phi * fade);
}

/** Dip of the horizon for fur at height `s` on a ball: −z of the lowest visible direction. */
const horizonDip = (s: number) => Math.sqrt(1 - (BODY_RADIUS / (BODY_RADIUS + s)) ** 2);

/**
 * ∫φ(ψ)·h(ψ)dψ around the horizon for h = 1, cos ψ, sin ψ, cos 2ψ, sin 2ψ: a row per h, a column per coefficient.
 *
 * @param at the horizon's direction at an azimuth: its first two components are φ's arguments
 */
export function horizonMoments(
	basis: Basis,
	at = (psi: number): Direction => [Math.cos(psi), Math.sin(psi), 0],
): number[][] {
	const spokes = 32; // exact for polynomials of degree 8 times cos 2ψ
	const step = (2 * Math.PI) / spokes;
	const rows = [1, 2, 3, 4, 5].map(() => new Array<number>(basis.kind === 'ptm' ? 6 : basis.matrix.length).fill(0));
	for (let i = 0; i < spokes; i++) {
		const psi = i * step;
		const phi = evaluateBasis(basis, at(psi));
		[1, Math.cos(psi), Math.sin(psi), Math.cos(2 * psi), Math.sin(2 * psi)].forEach((h, m) => {
			const row = rows[m] ?? [];
			phi.forEach((value, c) => {
				row[c] = (row[c] ?? 0) + step * h * value;
			});
		});
	}
	return rows;
}

/** Polynomials orthogonal over the half sphere, with their mean square. */
const ORTHOGONAL: readonly (readonly [square: number, of: (light: Direction) => number])[] = [
	[1, () => 1],
	[1 / 3, ([, , w]) => 2 * w - 1],
	[1 / 5, ([, , w]) => 6 * w * w - 6 * w + 1],
	[4 / 15, ([u, v]) => u * u - v * v],
	[1 / 15, ([u, v]) => u * v],
	[1 / 3, ([u]) => u],
	[1 / 3, ([, v]) => v],
	[19 / 960, ([u, , w]) => u * (w - 3 / 8)],
	[19 / 960, ([, v, w]) => v * (w - 3 / 8)],
];

/** Least-squares fit of functions over the half sphere by polynomials of degree 2. */
export class PolynomialFit {
	readonly #sums: Float64Array[];

	/** @param count number of functions */
	constructor(count: number) {
		this.#sums = Array.from({ length: count }, () => new Float64Array(ORTHOGONAL.length));
	}

	/** Adds another fit times a factor. */
	addAll(other: PolynomialFit, factor: number): void {
		for (const [c, sums] of this.#sums.entries())
			for (let t = 0; t < sums.length; t++) sums[t] = (sums[t] as number) + factor * (other.#sums[c]?.[t] ?? 0);
	}

	/**
	 * @param light in (T, B, N); of a fin (along the fur, as it is laid, across it, N)
	 * @param values of the functions there
	 * @param share of the half sphere around this light
	 */
	add(light: Direction, values: readonly number[], share: number): void {
		const terms = ORTHOGONAL.map(([square, of]) => (share * of(light)) / square);
		for (const [c, sums] of this.#sums.entries()) {
			const value = values[c] ?? 0;
			for (let t = 0; t < sums.length; t++) sums[t] = (sums[t] as number) + value * (terms[t] as number);
		}
	}

	/**
	 * Coefficients of p = (u², v², uv, u, v, 1, w, uw, vw): a row of nine per function.
	 *
	 * @param fin (u, v, w) are a fin's (along the fur, N, across it), not (T, B, N)
	 */
	rows(fin = false): number[][] {
		return this.#sums.map(([one = 0, rise = 0, bow = 0, side = 0, uv = 0, u = 0, v = 0, uw = 0, vw = 0]) =>
			fin
				? [
						...[2 * side, 6 * bow + side, uw],
						...[u - (3 / 8) * uw, 2 * rise - 6 * bow, one - rise + bow - side],
						...[v - (3 / 8) * vw, uv, vw],
					]
				: [
						...[side - 6 * bow, -side - 6 * bow, uv],
						...[u - (3 / 8) * uw, v - (3 / 8) * vw, one - rise + 7 * bow],
						...[2 * rise - 6 * bow, uw, vw],
					],
		);
	}
}

/** Light curves above the horizon as polynomials: φ_c ≈ Σ_j rows[c][j]·p_j, p as in `PolynomialFit`. */
export function polynomialCurves(basis: Basis): number[][] {
	const [heights, spokes] = [64, 32];
	const fit = new PolynomialFit(basis.kind === 'ptm' ? 6 : basis.matrix.length);
	for (let i = 0; i < heights * spokes; i++) {
		const w = (Math.floor(i / spokes) + 0.5) / heights;
		const [level, psi] = [Math.sqrt(1 - w * w), (2 * Math.PI * (i % spokes)) / spokes];
		const light: Direction = [level * Math.cos(psi), level * Math.sin(psi), w];
		fit.add(light, evaluateBasis(basis, light), 1 / (heights * spokes));
	}
	return fit.rows();
}

/**
 * Moments of the radiance R(ω) = Σ_j harmonics[j]·Y_j(ω) from all around, for fur at height `s`.
 *
 * @param matrix harmonics → moments of the upper hemisphere, a row per coefficient
 * @param harmonics nine, in the tangent frame
 */
export function environmentMoments(
	basis: Basis,
	matrix: readonly (readonly number[])[],
	harmonics: readonly number[],
	s: number,
): number[] {
	const [h0 = 0, hy = 0, hz = 0, hx = 0, hxy = 0, hyz = 0, hzz = 0, hxz = 0, hxxyy = 0] = harmonics;
	const [y0, y1, c1, c2] = [0.28209479, 0.48860251, 1.09254843, 0.31539157];
	// ∫√(1 + z/d)·{1, z, z²}dz over −d..0, and the same times ρ = √(1 − z²) to its second term.
	const d = horizonDip(s);
	const [one, z, zz] = [(2 / 3) * d, (-4 / 15) * d ** 2, (16 / 105) * d ** 3];
	const [rho, rhoZ, rhoRho] = [one - zz / 2, z + (16 / 315) * d ** 4, one - zz];
	const ring = [
		y0 * h0 * one + y1 * hz * z + c2 * hzz * (3 * zz - one),
		y1 * hx * rho + c1 * hxz * rhoZ,
		y1 * hy * rho + c1 * hyz * rhoZ,
		0.5 * c1 * hxxyy * rhoRho,
		0.5 * c1 * hxy * rhoRho,
	];
	const horizon = horizonMoments(basis);
	return matrix.map((row, i) => {
		const above = row.reduce((sum, weight, j) => sum + weight * (harmonics[j] ?? 0), 0);
		return ring.reduce((sum, light, m) => sum + light * (horizon[m]?.[i] ?? 0), above);
	});
}

/** L of a texel: its coefficients times the moments, never negative. */
export function relight(coefficients: readonly number[], moments: readonly number[]): number {
	return Math.max(
		coefficients.reduce((sum, a, i) => sum + a * (moments[i] ?? 0), 0),
		0,
	);
}
