/** Parabolas over one component of the light: through three points, and of least squares. */

import { Matrix, solve } from 'ml-matrix';

/** Coefficients of x², x and 1. */
export type Parabola = readonly [square: number, linear: number, constant: number];

export type Point = readonly [x: number, y: number];

export const valueAt = ([square, linear, constant]: Parabola, x: number): number =>
	(square * x + linear) * x + constant;

/** Parabola of least squared error; through three points of different x it is exact. */
export function parabolaOf(points: readonly Point[]): Parabola {
	const rows = new Matrix(points.map(([x]) => [x * x, x, 1]));
	const [square = 0, linear = 0, constant = 0] = solve(
		rows,
		Matrix.columnVector(points.map(([, y]) => y)),
		true,
	).to1DArray();
	return [square, linear, constant];
}

/** Root of the mean squared error. */
export function errorOf(parabola: Parabola, points: readonly Point[]): number {
	const sum = points.reduce((total, [x, y]) => total + (valueAt(parabola, x) - y) ** 2, 0);
	return Math.sqrt(sum / points.length);
}
