/** Check of a loaded mesh: numbers that no glTF may have reach hair roots, curvature and springs otherwise. */

import type { BufferGeometry } from 'three';

/** Numbers of an element, of attributes that the fur needs. */
const SIZES: Record<string, number> = { position: 3, normal: 3, tangent: 4, uv: 2 };

/**
 * @param where the mesh's role, put before what is wrong
 * @throws Error for indices without a vertex, attributes of another length or size than expected, numbers that are not finite
 */
export function checkGeometry(where: string, geometry: BufferGeometry): void {
	const { count } = geometry.getAttribute('position') ?? { count: 0 };
	for (const [name, attribute] of Object.entries(geometry.attributes)) {
		const size = SIZES[name] ?? attribute.itemSize;
		if (attribute.itemSize !== size || attribute.count !== count)
			throw new Error(
				`${where}: got ${attribute.count} ${name}s of ${attribute.itemSize} numbers, expected ${count} of ${size}`,
			);
		// Integers are finite.
		if (!(attribute.array instanceof Float32Array)) continue;
		for (let i = 0; i < count; i++) {
			for (let c = 0; c < size; c++) {
				const value = attribute.getComponent(i, c);
				if (!Number.isFinite(value))
					throw new Error(`${where}: got ${value} in the ${name} of vertex ${i}, expected a finite number`);
			}
		}
	}
	const { index } = geometry;
	if (!index) return;
	if (index.itemSize !== 1 || index.array instanceof Float32Array)
		throw new Error(
			`${where}: got indices of ${index.itemSize} ${index.array.constructor.name} numbers, expected one integer`,
		);
	const beyond = index.array.findIndex((vertex) => vertex >= count);
	if (beyond >= 0) throw new Error(`${where}: got vertex ${index.array[beyond]}, expected less than ${count}`);
}
