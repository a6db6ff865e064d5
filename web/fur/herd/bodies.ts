/** Culling, order and level of detail of many bodies, written into the caller's arrays. */

import type { Plane } from 'three';

/**
 * Distance of each body as the power of its sphere, |c − eye|² − r². Among disjoint spheres none hides one of less power,
 * whatever their sizes (Edelsbrunner 1990, "An acyclicity theorem for cell complexes in d dimension").
 *
 * @param spheres x, y, z, r of each body
 * @param eye x, y, z, 1; where rays are parallel x, y, z of the unit vector to the viewer, and 0
 * @param powers takes the result
 */
export function measurePowers(
	spheres: Float32Array,
	count: number,
	eye: readonly [number, number, number, number],
	powers: Float64Array,
): void {
	for (let i = 0; i < count; i++) {
		const x = spheres[4 * i] as number;
		const y = spheres[4 * i + 1] as number;
		const z = spheres[4 * i + 2] as number;
		const r = spheres[4 * i + 3] as number;
		powers[i] = eye[3]
			? (x - eye[0]) ** 2 + (y - eye[1]) ** 2 + (z - eye[2]) ** 2 - r * r
			: -(x * eye[0] + y * eye[1] + z * eye[2]);
	}
}

/**
 * Sorts bodies by falling power. Insertion sort, since little changes from frame to frame.
 *
 * @param order numbers of all bodies in their last order; takes the result
 */
export function sortFarFirst(order: Uint32Array, count: number, powers: Float64Array): void {
	for (let i = 1; i < count; i++) {
		const body = order[i] as number;
		const power = powers[body] as number;
		let j = i - 1;
		for (; j >= 0 && (powers[order[j] as number] as number) < power; j--) order[j + 1] = order[j] as number;
		order[j + 1] = body;
	}
}

/** @param seen takes 1 for each body that reaches between the planes, else 0 */
export function cullBodies(spheres: Float32Array, count: number, planes: readonly Plane[], seen: Uint8Array): void {
	for (let i = 0; i < count; i++) {
		seen[i] = 1;
		for (const { normal, constant } of planes) {
			const x = spheres[4 * i] as number;
			const y = spheres[4 * i + 1] as number;
			const z = spheres[4 * i + 2] as number;
			const distance = normal.x * x + normal.y * y + normal.z * z + constant;
			if (distance < -(spheres[4 * i + 3] as number)) seen[i] = 0;
		}
	}
}

/** Level of a body: the coarsest with enough shells. @param counts shells of each level, falling */
export function levelOf(shells: number, counts: readonly number[]): number {
	let level = counts.length - 1;
	while (level > 0 && (counts[level] as number) < shells) level--;
	return level;
}

/**
 * Cuts the sorted bodies into consecutive levels, so that whole levels can be drawn from far to near: each body gets the
 * level that it needs, or the finer one of a farther body.
 *
 * @param order numbers of all bodies, farthest first
 * @param seen result of `cullBodies`
 * @param levels own level of each body, 0 the finest
 * @param drawn takes the visible bodies, farthest first
 * @param ends takes for each level, the coarsest first, the end of its bodies in `drawn`
 */
export function cutLevels(
	order: Uint32Array,
	count: number,
	seen: Uint8Array,
	levels: Uint8Array,
	drawn: Uint32Array,
	ends: Uint32Array,
): void {
	let total = 0;
	let current = ends.length - 1;
	for (let i = 0; i < count; i++) {
		const body = order[i] as number;
		if (!seen[body]) continue;
		for (const level = levels[body] as number; current > level; current--) ends[current] = total;
		drawn[total++] = body;
	}
	for (; current >= 0; current--) ends[current] = total;
}
