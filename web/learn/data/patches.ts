/** Lapped patch of each vertex of the shells: patches share no vertex, so they are connected components. */

import type { BufferGeometry } from 'three';

/** Patches by vertex: `of` holds 0 .. `count` − 1. */
export function patchesOf({ index, attributes }: Pick<BufferGeometry, 'index' | 'attributes'>): {
	of: Uint32Array;
	count: number;
} {
	const above = Uint32Array.from({ length: attributes.position?.count ?? 0 }, (_, i) => i);
	const top = (vertex: number): number => {
		let at = vertex;
		while (above[at] !== at) {
			above[at] = above[above[at] as number] as number;
			at = above[at] as number;
		}
		return at;
	};
	const corners = index?.array ?? [];
	for (let i = 0; i < corners.length; i += 3)
		for (const other of [1, 2]) above[top(corners[i + other] as number)] = top(corners[i] as number);
	const names = new Map<number, number>();
	const of = above.map((_, vertex) => {
		const name = names.get(top(vertex)) ?? names.size;
		names.set(top(vertex), name);
		return name;
	});
	return { of, count: names.size };
}
