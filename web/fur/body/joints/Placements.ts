import { Matrix4, type Object3D, type SkinnedMesh } from 'three';
import type { Joints } from './joints.ts';

/** Placements of a body's joints, read from its skeleton or its node. */
export class Placements {
	readonly #mesh: Object3D;
	readonly #joints: Joints;
	/** Nodes whose matrices are of this frame. */
	readonly #fresh = new Set<Object3D>();
	readonly #matrix = new Matrix4();

	/** @param mesh shells' mesh */
	constructor(mesh: Object3D, joints: Joints) {
		this.#mesh = mesh;
		this.#joints = joints;
	}

	/**
	 * Reads the present placements, after the body's nodes have been moved.
	 *
	 * @param to column-major matrices: rest in the mesh's axes → world; singular ones (of a scale of 0, say) are not written
	 */
	read(to: Float64Array): void {
		const { bones } = this.#joints;
		const mesh = this.#mesh as SkinnedMesh;
		if (!mesh.skeleton) {
			mesh.updateWorldMatrix(true, false);
			if (Math.abs(mesh.matrixWorld.determinant()) > 0) mesh.matrixWorld.toArray(to);
			return;
		}
		this.#fresh.clear();
		this.#refresh(mesh);
		for (let joint = 0; joint < bones.length; joint++) {
			const matrix = this.#matrix.copy(mesh.matrixWorld);
			this.#bone(mesh, bones[joint] as number, matrix);
			if (Math.abs(matrix.determinant()) > 0) matrix.toArray(to, 16 * joint);
		}
	}

	/** Find the placement by a bone. */
	#bone({ skeleton, bindMatrix }: SkinnedMesh, at: number, matrix: Matrix4): void {
		const bone = skeleton.bones[at];
		const inverse = skeleton.boneInverses[at];
		if (!bone || !inverse) return;
		this.#refresh(bone);
		// The mesh itself moves nothing: it is attached.
		matrix.multiplyMatrices(bone.matrixWorld, inverse).multiply(bindMatrix);
	}

	/** Bring a node's matrix up to date, those above it first. */
	#refresh(node: Object3D): void {
		if (this.#fresh.has(node)) return;
		this.#fresh.add(node);
		if (node.parent) this.#refresh(node.parent);
		node.updateWorldMatrix(false, false);
	}
}
