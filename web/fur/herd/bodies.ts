/** Culling, order and level of detail of many bodies, written into the caller's arrays. */

import { type Camera, type Matrix4, type Plane, Sphere } from 'three';

const sphere = new Sphere();

/** Viewer: x, y, z, 1; where rays are parallel x, y, z of the unit vector to it, and 0. */
export type Eye = [number, number, number, number];

/** @param axes the camera's axes → those of the bodies; @param eye takes the camera in these */
export function findEye(camera: Camera, axes: Matrix4, eye: Eye): void {
	const parallel = camera.projectionMatrix.elements[15] === 1;
	for (let axis = 0; axis < 3; axis++) eye[axis] = axes.elements[(parallel ? 8 : 12) + axis] as number;
	eye[3] = parallel ? 0 : 1;
}

/**
 * Distance of each body as the power of its sphere, |c − eye|² − r². Among disjoint spheres none hides one of less power,
 * whatever their sizes (Edelsbrunner 1990, "An acyclicity theorem for cell complexes in d dimension").
 *
 * @param spheres x, y, z, r of each body
 * @param powers takes the result
 */
export function measurePowers(spheres: Float32Array, count: number, eye: Readonly<Eye>, powers: Float64Array): void {
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

/** @param bounds takes the sphere around all of them */
export function boundAll(spheres: Float32Array, count: number, bounds: Sphere): void {
	bounds.makeEmpty();
	for (let i = 0; i < count; i++) {
		sphere.center.fromArray(spheres, 4 * i);
		sphere.radius = spheres[4 * i + 3] as number;
		bounds.union(sphere);
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
