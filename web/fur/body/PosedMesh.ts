import { type BufferGeometry, type Material, type Matrix4, Mesh, type Skeleton } from 'three';
import type { FurPose, Jointed } from './FurPose.ts';

/** Mesh of a fur that takes the pose of its body: joints are those of the skin. */
export class PosedMesh<Geometry extends BufferGeometry, Look extends Material>
	extends Mesh<Geometry, Look>
	implements Jointed
{
	/** True where joints move the body, as on three's SkinnedMesh. @internal */
	declare isSkinnedMesh?: true;
	/** Joints of the skin. @internal */
	declare skeleton?: Skeleton;
	/** The skin's. @internal */
	declare bindMatrix?: Matrix4;
	/** World → the mesh's own units. @internal */
	declare bindMatrixInverse?: Matrix4;
	/** For SkeletonUtils.clone. @internal */
	declare bind?: Jointed['bind'];
	/** Pose of the body, if it has any. @internal */
	readonly pose: FurPose | undefined;

	constructor(geometry: Geometry, material: Look, pose: FurPose | undefined) {
		super(geometry, material);
		this.pose = pose;
		pose?.carry(this);
	}

	/** Takes the body's pose, too. @internal */
	override updateMatrixWorld(force?: boolean): void {
		super.updateMatrixWorld(force);
		this.pose?.follow(this);
	}
}
