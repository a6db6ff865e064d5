/** Least squares of eq. (2) and bytes of eq. (3) for a whole layer, as the baker does them. */

import { CholeskyDecomposition, Matrix, SingularValueDecomposition } from 'ml-matrix';
import { type Basis, type Direction, evaluateBasis } from '../../fur/reference.ts';

export const PTM: Basis = { kind: 'ptm' };

/** Functions of the light whose weights are a texel's numbers. */
export type Curves = (light: Direction) => number[];

/** Terms of eq. (2) by index. */
export function polynomial(terms: readonly number[]): Curves {
	return (light) => {
		const all = evaluateBasis(PTM, light);
		return terms.map((term) => all[term] ?? 0);
	};
}

/** First `count` light curves found for this fur. */
export function curvesFound({ degree, matrix }: { degree: number; matrix: number[][] }, count: number): Curves {
	const basis: Basis = { kind: 'eigen', degree, matrix: matrix.slice(0, count) };
	return (light) => evaluateBasis(basis, light);
}

/** Light matrix of eq. (2), decomposed once for all texels. */
export class Fit {
	/** Singular values, falling. */
	readonly singularValues: number[];
	/** (numbers, numbers): mean of φφᵀ over the lights. */
	readonly gram: Matrix;
	readonly #inverse: Matrix;
	/** Numbers per texel. */
	readonly numbers: number;

	/** @param lights lights of the fit: the first rows of a layer's measurements */
	constructor(curves: Curves, lights: readonly Direction[]) {
		const rows = new Matrix(lights.map(curves));
		const svd = new SingularValueDecomposition(rows, { autoTranspose: true });
		this.singularValues = svd.diagonal;
		this.#inverse = svd.inverse();
		this.gram = rows.transpose().mmul(rows).div(rows.rows);
		this.numbers = rows.columns;
	}

	/**
	 * @param light L, a row per light, as many columns as there are texels
	 * @returns numbers of every texel, texel after texel
	 */
	texels(light: Float32Array, count: number): Float64Array {
		const { numbers } = this;
		const found = new Float64Array(count * numbers);
		for (let i = 0; i < numbers; i++) {
			for (let n = 0; n < this.#inverse.columns; n++) {
				const weight = this.#inverse.get(i, n);
				for (let t = 0; t < count; t++) {
					const at = t * numbers + i;
					found[at] = (found[at] as number) + weight * (light[n * count + t] as number);
				}
			}
		}
		return found;
	}
}

/** λ and Ω of codes with `bits` bits over the bytes' range. */
export function rangeOf(
	{ scale, bias }: { scale: readonly number[]; bias: readonly number[] },
	bits: number,
): { scale: number[]; bias: number[]; top: number } {
	const top = 2 ** bits - 1;
	return { scale: scale.map((step) => (step * 255) / top), bias: bias.map((zero) => (zero * top) / 255), top };
}

/**
 * Codes of eq. (3): a' = round(a/λ + Ω), one number after the other, the last first, each compensating the rounding of
 * those before it.
 */
export function quantise(
	numbers: Float64Array,
	{ scale, bias, top }: { scale: readonly number[]; bias: readonly number[]; top: number },
	gram: Matrix,
): Uint16Array {
	const count = scale.length;
	const weights = Matrix.zeros(count, count);
	for (let i = 0; i < count; i++)
		for (let j = 0; j <= i; j++) {
			const weight = gram.get(i, j) * (scale[i] as number) * (scale[j] as number);
			weights.set(i, j, weight);
			weights.set(j, i, weight);
		}
	const upper = new CholeskyDecomposition(weights).lowerTriangularMatrix.transpose();
	const share = Matrix.zeros(count, count);
	for (let i = 0; i < count; i++)
		for (let j = i + 1; j < count; j++) share.set(i, j, upper.get(i, j) / upper.get(i, i));
	const codes = new Uint16Array(numbers.length);
	const carried = new Float64Array(count);
	for (let first = 0; first < numbers.length; first += count) {
		for (let i = count - 1; i >= 0; i--) {
			const wanted = (numbers[first + i] as number) / (scale[i] as number) + (bias[i] as number);
			let target = wanted;
			for (let j = i + 1; j < count; j++) target += share.get(i, j) * (carried[j] as number);
			const code = Math.min(Math.max(Math.round(target), 0), top);
			codes[first + i] = code;
			carried[i] = wanted - code;
		}
	}
	return codes;
}

/** a = λ(a' − Ω) */
export function dequantise(
	codes: Uint8Array | Uint16Array,
	{ scale, bias }: { scale: readonly number[]; bias: readonly number[] },
): Float64Array {
	const count = scale.length;
	return Float64Array.from(codes, (code, i) => (scale[i % count] as number) * (code - (bias[i % count] as number)));
}

/** L of every texel, never negative, as in the shader. */
export function relitTexels(numbers: Float64Array, moments: readonly number[]): Float32Array {
	const count = moments.length;
	const light = new Float32Array(numbers.length / count);
	for (let t = 0; t < light.length; t++) {
		let sum = 0;
		for (let i = 0; i < count; i++) sum += (numbers[t * count + i] as number) * (moments[i] as number);
		light[t] = Math.max(sum, 0);
	}
	return light;
}

/** Decibels of a mean squared error relative to a peak of 1. */
export const decibels = (error: number): number => -10 * Math.log10(Math.max(error, 1e-12));

/** Decibels between two pictures, texels weighted by coverage. */
export function psnr(a: ArrayLike<number>, b: ArrayLike<number>, weights: ArrayLike<number>, peak: number): number {
	let [sum, total] = [0, 0];
	for (let t = 0; t < weights.length; t++) {
		const weight = weights[t] as number;
		sum += weight * (((a[t] as number) - (b[t] as number)) / peak) ** 2;
		total += weight;
	}
	return decibels(sum / total);
}
