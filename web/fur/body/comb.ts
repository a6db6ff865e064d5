/** Comb of the fur: from the file's attribute to one without seams between patches. */

import { BufferAttribute, type BufferGeometry, Vector3 } from 'three';
import { weld } from './weld.ts';

/**
 * The tips' displacement in the mesh's own axes, shares of the length, from `_comb` along T and B.
 *
 * Where patches overlap, each copy of a vertex has its own tangents and rounding. Shells that differ in the last bit fight
 * for depth, so all copies get the mean.
 *
 * @returns undefined where nothing is combed
 */
export function sharedComb(surface: BufferGeometry): BufferAttribute | undefined {
	const [comb, position, normal, tangent] = ['_comb', 'position', 'normal', 'tangent'].map((name) =>
		surface.getAttribute(name),
	);
	if (!comb || !position || !normal || !tangent) return undefined;
	const [n, t, b] = [new Vector3(), new Vector3(), new Vector3()];
	const { count, point } = weld(surface);
	const sums = new Float64Array(count * 4);
	for (let i = 0; i < comb.count; i++) {
		const copy = point[i] as number;
		n.fromBufferAttribute(normal, i).normalize();
		t.fromBufferAttribute(tangent, i).addScaledVector(n, -n.dot(t)).normalize();
		b.crossVectors(n, t).multiplyScalar(tangent.getW(i) * comb.getY(i));
		t.multiplyScalar(comb.getX(i)).add(b);
		for (const [axis, value] of [t.x, t.y, t.z, 1].entries())
			sums[copy * 4 + axis] = (sums[copy * 4 + axis] ?? 0) + value;
	}
	const shared = new Float32Array(comb.count * 3).map((_, i) => {
		const copy = (point[Math.floor(i / 3)] ?? 0) * 4;
		return (sums[copy + (i % 3)] ?? 0) / (sums[copy + 3] ?? 1);
	});
	return new BufferAttribute(shared, 3);
}
