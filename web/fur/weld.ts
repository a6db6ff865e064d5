/** Which vertices of a surface are one and the same: where patches overlap each of them brings a copy. */

import { type BufferGeometry, Vector3 } from 'three';

/** Vertices by the points that they are copies of. */
export interface Weld {
	/** How many points there are. */
	count: number;
	/** Of each vertex the number of its point, in the order in which points come first. */
	point: Uint32Array;
}

/** Copies have position and normal in common, to the bit; tangents and texture coordinates are each patch's own. */
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
