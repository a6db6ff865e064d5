/** Places of several furs on one body. See shaders/hair/regions/region.glsl. */

import { BufferAttribute, type BufferGeometry } from 'three';

/**
 * Checks the attribute `_region` of shells or fins, and gives their vertices `regionSlope`.
 *
 * @param furs beside the coat
 * @param where of the mesh, for messages
 * @throws Error that says what is wrong
 */
export function markFurs(surface: BufferGeometry, furs: number, where: string): void {
	const region = surface.getAttribute('_region');
	if (!region) throw new Error(`${where}: the mesh has no _REGION, expected one of a body with several furs`);
	for (let i = 0; i < region.count; i++) {
		const fur = Math.round(255 * region.getZ(i));
		if (!(fur <= furs)) throw new Error(`${where}: _REGION names fur ${fur}, expected 0 to ${furs}`);
		if (!(region.getX(i) <= region.getY(i)))
			throw new Error(`${where}: _REGION has bounds ${region.getX(i)} and ${region.getY(i)}, expected rising ones`);
	}
	surface.setAttribute('regionSlope', regionSlopes(surface));
}

/** Bounds nearer to 0 or 1 than this are whole. */
const WHOLE = 0.5 / 255;

/**
 * Growth of the two bounds of `_region` along u and v at each vertex, per unit of its texture coordinates: XY of the
 * lower, ZW of the upper; 0 where a bound is 0 or 1, so that furs share every place among them.
 */
export function regionSlopes(surface: BufferGeometry): BufferAttribute {
	const [region, uv] = [surface.getAttribute('_region'), surface.getAttribute('uv')];
	const slopes = new Float32Array(4 * region.count);
	const areas = new Float32Array(region.count);
	const index = surface.index as BufferAttribute;
	for (let i = 0; i < index.count; i += 3) {
		const corners = [index.getX(i), index.getX(i + 1), index.getX(i + 2)] as const;
		const [a, b, c] = corners;
		const [u1, v1] = [uv.getX(b) - uv.getX(a), uv.getY(b) - uv.getY(a)];
		const [u2, v2] = [uv.getX(c) - uv.getX(a), uv.getY(c) - uv.getY(a)];
		const area = u1 * v2 - u2 * v1;
		if (area === 0) continue;
		for (let bound = 0; bound < 2; bound++) {
			const [d1, d2] = [b, c].map((at) => region.getComponent(at, bound) - region.getComponent(a, bound)) as [
				number,
				number,
			];
			const sign = Math.sign(area);
			for (const at of corners) {
				const to = 4 * at + 2 * bound;
				slopes[to] = (slopes[to] as number) + sign * (d1 * v2 - d2 * v1);
				slopes[to + 1] = (slopes[to + 1] as number) + sign * (d2 * u1 - d1 * u2);
			}
		}
		for (const at of corners) areas[at] = (areas[at] as number) + Math.abs(area);
	}
	for (let at = 0; at < region.count; at++)
		for (let bound = 0; bound < 2; bound++) {
			const value = region.getComponent(at, bound);
			const scale = value < WHOLE || value > 1 - WHOLE ? 0 : 1 / Math.max(areas[at] as number, 1e-12);
			for (let axis = 0; axis < 2; axis++) {
				const to = 4 * at + 2 * bound + axis;
				slopes[to] = (slopes[to] as number) * scale;
			}
		}
	return new BufferAttribute(slopes, 4);
}
