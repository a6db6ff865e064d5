/** Pose of a body, by joints and morph targets of its skin. */

import {
	type BufferGeometry,
	DetachedBindMode,
	Matrix4,
	type Mesh,
	type Object3D,
	type Skeleton,
	type SkinnedMesh,
	Sphere,
	Vector3,
} from 'three';
import { isSkinned } from './joints/restPoint.ts';
import { Morphs, MorphWeights } from './Morphs.ts';
import { type BoundedSurface, PosedBounds } from './PosedBounds.ts';

/** Properties that three reads of an object drawn by joints. */
export interface Jointed extends Object3D {
	isSkinnedMesh?: true;
	skeleton?: Skeleton;
	bindMatrix?: Matrix4;
	bindMatrixInverse?: Matrix4;
	bind?(skeleton: Skeleton, bindMatrix?: Matrix4): void;
}

const NONE: readonly number[] = [];
const inverse = new Matrix4();
const point = new Vector3();

/**
 * Pose of a body: joints and influences are those of its skin, whoever moves them. Shells, fins, light and hull of all its
 * furs follow it on the GPU; here are their bounds, and the way back from a place on the posed skin to that at rest.
 */
export class FurPose {
	/** Number of morph targets. */
	readonly targets: number;
	/** Present weights of the targets, for materials. */
	readonly weights = new MorphWeights();
	/** Bounding sphere of the skin in its pose, world. */
	readonly sphere = new Sphere();
	/** Largest world length of a unit of the shells' mesh. */
	unit = 1;
	readonly #pieces: readonly Mesh[];
	#bounds: PosedBounds | undefined;

	/** @param pieces of the skin @returns undefined for a body that has no joints and no targets */
	static of(pieces: readonly Mesh[]): FurPose | undefined {
		const moves = pieces.some((piece) => isSkinned(piece) || piece.geometry.morphAttributes.position?.length);
		return moves ? new FurPose(pieces) : undefined;
	}

	private constructor(pieces: readonly Mesh[]) {
		this.#pieces = pieces;
		this.targets = Math.max(...pieces.map(({ geometry }) => geometry.morphAttributes.position?.length ?? 0));
	}

	/** The skin's own; undefined without joints. */
	get skeleton(): Skeleton | undefined {
		return this.#jointed?.skeleton;
	}

	/** Weights of the morph targets: the skin's own `morphTargetInfluences`. */
	get influences(): readonly number[] {
		for (const { morphTargetInfluences } of this.#pieces)
			if (morphTargetInfluences?.length) return morphTargetInfluences;
		return NONE;
	}

	get #jointed(): SkinnedMesh | undefined {
		for (const piece of this.#pieces) if (isSkinned(piece)) return piece;
		return undefined;
	}

	/** Morph targets of a geometry on this body, if it has any. */
	morphsOf(geometry: BufferGeometry): Morphs | undefined {
		return Morphs.of(geometry);
	}

	/** Most targets in use at a time. */
	get slots(): number {
		return MorphWeights.slots(this.targets);
	}

	/** Lets an object be drawn by the skin's joints. */
	carry(object: Jointed): void {
		const { skeleton } = this;
		if (!skeleton) return;
		object.isSkinnedMesh = true;
		object.bindMatrix = new Matrix4();
		object.bindMatrixInverse = new Matrix4();
		// For SkeletonUtils.clone; what counts is the skin's.
		object.bind = () => this.follow(object);
		this.follow(object);
	}

	/** Updates what `carry` has given; call it after the object's world matrix has changed. */
	follow(object: Jointed): void {
		const skin = this.#jointed;
		if (!skin || !object.bindMatrix || !object.bindMatrixInverse) return;
		object.skeleton = skin.skeleton;
		object.bindMatrix.copy(skin.bindMatrix);
		const { bindMode } = skin;
		object.bindMatrixInverse.copy(bindMode === DetachedBindMode ? skin.bindMatrix : object.matrixWorld).invert();
	}

	/**
	 * Finds weights and bounds of the present pose; call it once world matrices are up to date.
	 *
	 * @param shells mesh of a fur of this body
	 * @param surface its geometry
	 */
	update(shells: Object3D, surface: BufferGeometry): void {
		const { influences, skeleton } = this;
		this.weights.write(influences, this.targets);
		this.#bounds ??= this.#bound(shells, surface);
		const placement = skeleton ? (this.#jointed as SkinnedMesh).bindMatrix : shells.matrixWorld;
		this.unit = this.#bounds.measure(skeleton, placement, influences, this.sphere);
		for (const piece of this.#pieces) {
			const bounded = piece as Partial<SkinnedMesh>;
			bounded.boundingSphere ??= new Sphere();
			bounded.boundingSphere.copy(this.sphere).applyMatrix4(inverse.copy(piece.matrixWorld).invert());
		}
	}

	#bound(shells: Object3D, surface: BufferGeometry): PosedBounds {
		const morphs = Morphs.of(surface);
		const reach = morphs && ((vertex: number, target: number) => morphs.reach(vertex, target));
		const back = shells.matrixWorld.clone().invert();
		const surfaces = this.#pieces.map((piece): BoundedSurface => {
			const { geometry } = piece;
			const changes = geometry.morphAttributes.position;
			return {
				geometry,
				// Joints take the units of all alike.
				matrix: isSkinned(piece) ? new Matrix4() : piece.matrixWorld.clone().premultiply(back),
				reach:
					changes &&
					((vertex, target) => {
						const change = changes[target];
						return change ? point.fromBufferAttribute(change, vertex).length() : 0;
					}),
			};
		});
		return new PosedBounds([...surfaces, { geometry: surface, matrix: new Matrix4(), reach }], this.targets);
	}

	/** Updates world matrices of skin and joints, for a look between two frames. */
	refresh(): void {
		const [piece] = this.#pieces;
		const top = piece?.parent?.parent ?? piece?.parent ?? piece;
		top?.updateWorldMatrix(true, true);
		const { skeleton } = this;
		for (const bone of skeleton?.bones ?? []) if (bone) bone.updateWorldMatrix(true, false);
	}

	/** The skin is drawn by three's own bounds again. */
	release(): void {
		for (const piece of this.#pieces) Object.assign(piece, { boundingSphere: isSkinned(piece) ? null : undefined });
	}
}
