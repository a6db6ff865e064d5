import { type BufferGeometry, DetachedBindMode, Matrix4, Mesh, type Skeleton, type SkinnedMesh } from 'three';
import type { Jointed } from '../body/FurPose.ts';

/** Mesh drawn for a lamp in place of another one: the same vertices, at the same place, in the same pose. */
export class LightDouble extends Mesh<BufferGeometry> implements Jointed {
	/** Joints of the original, as on three's SkinnedMesh. */
	declare isSkinnedMesh?: true;
	declare skeleton?: Skeleton;
	declare bindMatrix?: Matrix4;
	declare bindMatrixInverse?: Matrix4;
	readonly #of: Mesh & Jointed & Pick<Partial<SkinnedMesh>, 'bindMode'>;

	constructor(of: Mesh, material: Mesh['material']) {
		super(of.geometry, material);
		this.#of = of;
		this.frustumCulled = false;
		this.matrixAutoUpdate = this.matrixWorldAutoUpdate = false;
	}

	/** Moves to the original, whose joints are up to date. */
	follow(): void {
		const { morphTargetInfluences, skeleton, bindMatrix, bindMode } = this.#of;
		this.#of.updateWorldMatrix(true, false);
		this.matrixWorld.copy(this.#of.matrixWorld);
		if (morphTargetInfluences) this.morphTargetInfluences = morphTargetInfluences;
		if (!skeleton || !bindMatrix) return;
		this.isSkinnedMesh = true;
		this.skeleton = skeleton;
		this.bindMatrix = bindMatrix;
		this.bindMatrixInverse ??= new Matrix4();
		this.bindMatrixInverse.copy(bindMode === DetachedBindMode ? bindMatrix : this.matrixWorld).invert();
	}

	/** Tells all numbers of its place and morph targets. */
	tell(note: (value: number) => void): void {
		this.matrixWorld.elements.forEach(note);
		this.morphTargetInfluences?.forEach(note);
	}
}
