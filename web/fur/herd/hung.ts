/** Meshes that hang on joints (eyes, say), as skin that follows its joint: bodies in poses of their own share draws. */

import {
	BufferAttribute,
	BufferGeometry,
	Float32BufferAttribute,
	Matrix3,
	Matrix4,
	Mesh,
	type Object3D,
	type Skeleton,
	Vector3,
} from 'three';
import { placement } from './pieces.ts';

/** Mesh that the joint above it moves, in the units of the skin; a mesh that hangs on no joint, as it is. */
export function hung(mesh: Mesh, skeleton: Skeleton): Mesh {
	const bones: readonly Object3D[] = skeleton.bones;
	let above = mesh.parent;
	while (above && !bones.includes(above)) above = above.parent;
	if (!above || mesh.geometry.hasAttribute('skinIndex')) return mesh;
	const joint = bones.indexOf(above);
	const inverse = skeleton.boneInverses[joint] ?? new Matrix4();
	const copy = new Mesh(jointed(mesh.geometry, joint, inverse.clone().invert().multiply(placement(mesh, above))));
	copy.material = mesh.material;
	copy.name = mesh.name;
	copy.castShadow = mesh.castShadow;
	copy.receiveShadow = mesh.receiveShadow;
	return copy;
}

/** Geometry with positions and normals in other axes, all of it moved by one joint. */
function jointed(source: BufferGeometry, joint: number, units: Matrix4): BufferGeometry {
	const geometry = new BufferGeometry();
	geometry.setIndex(source.index);
	for (const [name, attribute] of Object.entries(source.attributes)) geometry.setAttribute(name, attribute);
	const { count } = source.getAttribute('position');
	const turn = new Matrix3().getNormalMatrix(units);
	const vector = new Vector3();
	for (const name of ['position', 'normal'] as const) {
		const before = source.getAttribute(name);
		if (!before) continue;
		const after = new Float32BufferAttribute(3 * count, 3);
		for (let i = 0; i < count; i++) {
			vector.fromBufferAttribute(before, i);
			if (name === 'position') vector.applyMatrix4(units);
			else vector.applyNormalMatrix(turn);
			after.setXYZ(i, vector.x, vector.y, vector.z);
		}
		geometry.setAttribute(name, after);
	}
	const joints = new Uint16Array(4 * count);
	const weights = new Float32Array(4 * count);
	for (let i = 0; i < count; i++) {
		joints[4 * i] = joint;
		weights[4 * i] = 1;
	}
	geometry.setAttribute('skinIndex', new BufferAttribute(joints, 4));
	geometry.setAttribute('skinWeight', new BufferAttribute(weights, 4));
	return geometry;
}
