/** Welding of vertices: overlapping patches each bring a copy of a point. */

import { type BufferGeometry, Vector3 } from 'three';

/** Points of a surface, and the point of every vertex. */
export interface Weld {
	/** Number of points. */
	count: number;
	/** Point of each vertex, numbered in order of first appearance. */
	point: Uint32Array;
}

/** Welds vertices of equal position and normal, to the bit; tangents and texture coordinates may differ. */
export function weld(surface: BufferGeometry): Weld {
	const [position, normal] = [surface.getAttribute('position'), surface.getAttribute('normal')];
	const n = new Vector3();
	const found = new Map<string, number>();
	const point = new Uint32Array(position.count);
	for (let i = 0; i < position.count; i++) {
		n.fromBufferAttribute(normal, i);
		const key = [position.getX(i), position.getY(i), position.getZ(i), n.x, n.y, n.z].join();
		const copy = found.get(key) ?? found.size;
		if (copy === found.size) found.set(key, copy);
		point[i] = copy;
	}
	return { count: found.size, point };
}
