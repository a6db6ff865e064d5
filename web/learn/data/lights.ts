/** Lights in the tile's axes. The tile lies on the ground: u to the right, v away from the reader, its normal upwards. */

import type { Vector3 } from 'three';
import type { Direction } from '../../fur/reference.ts';

/** World axes (x right, y up, z towards the reader) → the tile's (lu, lv, lz). */
export function toTile({ x, y, z }: Readonly<Pick<Vector3, 'x' | 'y' | 'z'>>): Direction {
	return [x, -z, y];
}

/** Inverse of `toTile`. */
export function toWorld([u, v, z]: Direction): [number, number, number] {
	return [u, z, -v];
}

/** Index of the light nearest to a direction. */
export function nearest(lights: readonly Direction[], [u, v, z]: Direction): number {
	let [best, found] = [-2, 0];
	lights.forEach(([lu, lv, lz], i) => {
		const cosine = lu * u + lv * v + lz * z;
		if (cosine > best) [best, found] = [cosine, i];
	});
	return found;
}

/**
 * Next light in a direction on the disc of (lu, lv), if any.
 *
 * @param right, up a unit vector on the disc
 */
export function neighbour(lights: readonly Direction[], from: number, right: number, up: number): number | undefined {
	const [u0, v0] = lights[from] ?? [0, 0];
	let [best, found]: [number, number | undefined] = [Number.POSITIVE_INFINITY, undefined];
	lights.forEach(([u, v], i) => {
		const along = (u - u0) * right + (v - v0) * up;
		const across = Math.abs((u - u0) * up - (v - v0) * right);
		if (i === from || along <= 1e-6 || across > along) return;
		const cost = along + 2 * across;
		if (cost < best) [best, found] = [cost, i];
	});
	return found;
}

const DEGREES = 180 / Math.PI;

/** Degrees above the ground. */
export const elevationOf = ([, , z]: Direction): number => Math.asin(Math.min(Math.max(z, -1), 1)) * DEGREES;

/** Degrees between two directions. */
export const angleBetween = ([a, b, c]: Direction, [u, v, w]: Direction): number =>
	Math.acos(Math.min(a * u + b * v + c * w, 1)) * DEGREES;
