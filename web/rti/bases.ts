/** Functions of the light that relight's formats use. */

import type { Light } from './relit.ts';

/** Radians above the horizon to which lights of hemispherical harmonics are raised. */
const GRAZING = 0.15;
/** Share of a radial function below which relight leaves it out. */
const NEAR = 1e-3;

const { PI, sqrt } = Math;

/** The polynomial in relight's order. */
export const polynomial = ([u, v]: Light): number[] => [1, u, v, u * u, u * v, v * v];

/** Hemispherical harmonics of order 2 (Gautron et al. 2004). */
export function hemispherical([u, v, z]: Light): number[] {
	const azimuth = Math.atan2(v, u);
	const c = Math.cos(Math.min(Math.acos(Math.min(Math.max(z, -1), 1)), PI / 2 - GRAZING));
	const ring = sqrt(Math.max(c - c * c, 0));
	const band = 2 * c - 1;
	return [
		sqrt(1 / (2 * PI)),
		sqrt(6 / PI) * ring * Math.cos(azimuth),
		sqrt(3 / (2 * PI)) * band,
		sqrt(6 / PI) * ring * Math.sin(azimuth),
		sqrt(30 / PI) * (c * c - c) * Math.cos(2 * azimuth),
		sqrt(30 / PI) * band * ring * Math.cos(azimuth),
		sqrt(5 / (2 * PI)) * (6 * c * c - 6 * c + 1),
		sqrt(30 / PI) * band * ring * Math.sin(azimuth),
		sqrt(30 / PI) * (c * c - c) * Math.sin(2 * azimuth),
	];
}

/** Spherical harmonics of order 2 in relight's order and signs. */
export function spherical([x, y, z]: Light): number[] {
	const [a, b] = [sqrt(3 / (4 * PI)), sqrt(15 / (4 * PI))];
	return [
		...[sqrt(1 / (4 * PI)), a * x, a * z, a * y, b * x * y, b * x * z],
		...[(sqrt(5 / PI) / 4) * (3 * z * z - 1), b * y * z, (b / 2) * (y * y - x * x)],
	];
}

/** Gaussians around lamps, three numbers each; their sum is 1. */
export function radial([u, v, z]: Light, lamps: readonly number[], sigma: number): number[] {
	const squares = Array.from({ length: lamps.length / 3 }, (_, i) => {
		const [x = 0, y = 0, w = 0] = lamps.slice(3 * i, 3 * i + 3);
		return (x - u) ** 2 + (y - v) ** 2 + (w - z) ** 2;
	});
	const nearest = Math.min(...squares);
	const near = shared(squares.map((square) => Math.exp((nearest - square) / sigma ** 2)));
	return shared(near.map((share) => (share > NEAR ? share : 0)));
}

function shared(values: readonly number[]): number[] {
	const sum = values.reduce((total, value) => total + value, 0);
	return values.map((value) => value / sum);
}

/** Four neighbours on a lattice over the octahedron, row by row. */
export function lattice([x, y, z]: Light, resolution: number): number[] {
	const size = Math.abs(x) + Math.abs(y) + Math.abs(z);
	const shares: number[] = Array(resolution * resolution).fill(0);
	const [a, b] = [x + y, y - x].map((axis) => ((axis / size + 1) / 2) * (resolution - 1)) as [number, number];
	const [left, top] = [a, b].map((axis) => Math.min(Math.max(Math.floor(axis), 0), resolution - 2)) as [number, number];
	for (const right of [0, 1])
		for (const down of [0, 1])
			shares[(top + down) * resolution + left + right] =
				(1 - Math.abs(a - left - right)) * (1 - Math.abs(b - top - down));
	return shares;
}
