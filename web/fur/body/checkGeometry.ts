/** Check of a loaded mesh: numbers that no glTF may have reach hair roots, curvature and springs otherwise. */

import type { BufferGeometry } from 'three';

/** Numbers of an element, of attributes that the fur needs. */
const SIZES: Record<string, number> = { position: 3, normal: 3, tangent: 4, uv: 2, skinIndex: 4, skinWeight: 4 };

/**
 * @param where the mesh's role, put before what is wrong
 * @param joints of its skeleton, if it has one
 * @throws Error for indices without a vertex, attributes of another length or size than expected, numbers that are not finite
 */
export function checkGeometry(where: string, geometry: BufferGeometry, joints?: number): void {
	const { count } = geometry.getAttribute('position') ?? { count: 0 };
	const named = [
		...Object.entries(geometry.attributes),
		...Object.entries(geometry.morphAttributes).flatMap(([name, targets]) =>
			(targets ?? []).map((changes, i) => [`${name} of target ${i}`, changes] as const),
		),
	];
	for (const [name, attribute] of named) {
		const size = SIZES[name] ?? (name.includes(' ') ? 3 : attribute.itemSize);
		if (attribute.itemSize !== size || attribute.count !== count)
			throw new Error(
				`${where}: got ${attribute.count} ${plural(name)} of ${attribute.itemSize} numbers, expected ${count} of ${size}`,
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
	checkJoints(where, geometry, joints);
	const { index } = geometry;
	if (!index) return;
	if (index.itemSize !== 1 || index.array instanceof Float32Array)
		throw new Error(
			`${where}: got indices of ${index.itemSize} ${index.array.constructor.name} numbers, expected one integer`,
		);
	const beyond = index.array.findIndex((vertex) => vertex >= count);
	if (beyond >= 0) throw new Error(`${where}: got vertex ${index.array[beyond]}, expected less than ${count}`);
}

/** `normals`, `normals of target 2`. */
const plural = (name: string) => name.replace(/^\w+/, '$&s');

/** Checks that vertices are moved by joints of the skeleton. */
function checkJoints(where: string, geometry: BufferGeometry, joints: number | undefined): void {
	const { skinIndex } = geometry.attributes;
	if (joints === undefined || !skinIndex) return;
	for (let i = 0; i < skinIndex.count; i++)
		for (let c = 0; c < 4; c++) {
			const joint = skinIndex.getComponent(i, c);
			if (!(joint < joints))
				throw new Error(`${where}: got joint ${joint} at vertex ${i}, expected less than ${joints}`);
		}
}
