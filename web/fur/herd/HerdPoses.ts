import { DataTexture, FloatType, Matrix4, RGBAFormat, Skeleton, Sphere } from 'three';
import type { Jointed } from '../body/FurPose.ts';

/** Poses that the bodies of a herd can share. */
export const MAX_POSES = 8;

const matrix = new Matrix4();

/**
 * Joints of a body in several poses, in its own axes: a skeleton to three, whose bones are those of all poses, one after the
 * other.
 */
export class HerdPoses extends Skeleton {
	/** Joints of the body itself. */
	readonly own: Skeleton;
	/** Sphere around the body in all poses so far, fur included, the body's axes. */
	readonly sphere = new Sphere().makeEmpty();

	/** @param own joints of the body itself */
	constructor(own: Skeleton) {
		super([], []);
		this.own = own;
		const joints = own.bones.length;
		const side = 4 * Math.ceil(Math.sqrt(4 * joints * MAX_POSES) / 4);
		this.boneMatrices = new Float32Array(4 * side * side);
		this.boneTexture = new DataTexture(this.boneMatrices, side, side, RGBAFormat, FloatType);
		for (let i = 0; i < joints * MAX_POSES; i++) matrix.identity().toArray(this.boneMatrices, 16 * i);
		this.boneTexture.needsUpdate = true;
	}

	/** Number of the first joint of a pose. */
	first(pose: number): number {
		return pose * this.own.bones.length;
	}

	/**
	 * Copies the body's present pose, as the world matrices of its bones say it.
	 *
	 * @param pose number to keep it under
	 * @param body world → the body's axes
	 * @param sphere around body and fur in this pose, world
	 * @returns whether the sphere around all poses has grown
	 */
	capture(pose: number, body: Matrix4, sphere: Sphere): boolean {
		const { boneMatrices, boneTexture } = this;
		for (const [i, bone] of this.own.bones.entries()) {
			const inverse = this.own.boneInverses[i];
			if (!inverse) continue;
			matrix.multiplyMatrices(body, bone.matrixWorld).multiply(inverse);
			matrix.toArray(boneMatrices as Float32Array, 16 * (this.first(pose) + i));
		}
		if (boneTexture) boneTexture.needsUpdate = true;
		const { radius } = this.sphere;
		this.sphere.union(sphere.applyMatrix4(body));
		return this.sphere.radius > radius;
	}

	/**
	 * Lets an object be drawn by these joints.
	 *
	 * @param units its axes → the body's, where the joints leave its vertices in its own units
	 */
	carry(object: Jointed, units = new Matrix4()): void {
		object.isSkinnedMesh = true;
		object.skeleton = this;
		object.bindMatrix = new Matrix4();
		object.bindMatrixInverse = units.clone().invert();
	}

	/** Called by the renderer; `capture` has done it. */
	override update(): void {}
}
