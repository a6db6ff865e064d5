import { InstancedMesh, type Material, Matrix4, type Mesh, type Object3D, type Sphere, Vector4 } from 'three';
import type { Jointed } from '../body/FurPose.ts';
import { keepThin } from '../body/skin/thin.ts';
import { FurFins } from '../shells/FurFins.ts';
import { FurShells } from '../shells/FurShells.ts';
import type { HerdPoses } from './HerdPoses.ts';
import { hung } from './hung.ts';
import { Places } from './Places.ts';
import { gatherPieces, type Piece, placement } from './pieces.ts';
import { PosedMaterial } from './posedMaterial.ts';

const total = new Matrix4();
const viewport = new Vector4();

/** Whether joints move its vertices. */
const isJointed = ({ geometry }: Pick<Mesh, 'geometry'>): boolean => geometry.hasAttribute('skinIndex');

/** A piece for all bodies. */
interface InstancedPiece {
	piece: Piece;
	mesh: InstancedMesh;
	/** Material of a piece that joints move. */
	posed: PosedMaterial | undefined;
	places: Places;
	/** Matrices of all bodies. */
	matrices: Float32Array;
}

/** Opaque meshes of all bodies of a herd: the skin, and what stands beside it (eyes, say). */
export class HerdSkin {
	readonly #pieces: readonly InstancedPiece[];
	/** Meshes that hang on joints, as skin. */
	readonly #copies: readonly Mesh[];

	/**
	 * @param root of one body
	 * @param capacity largest number of bodies
	 * @param bounds of all bodies
	 * @param poses of a body that has joints
	 * @param drawn called before each draw with the height of the picture, pixels
	 */
	constructor(
		root: Object3D,
		capacity: number,
		bounds: Sphere,
		poses: HerdPoses | undefined,
		drawn: (height: number) => void,
	) {
		const height = { value: 0 };
		const meshes: Mesh[] = [];
		root.traverse((part) => {
			if ((part as Mesh).isMesh && !(part instanceof FurShells || part instanceof FurFins)) meshes.push(part as Mesh);
		});
		const hanging = poses ? meshes.map((mesh) => hung(mesh, poses.own)) : meshes;
		this.#copies = hanging.filter((mesh) => !meshes.includes(mesh));
		const axes = (mesh: Mesh) => (poses && isJointed(mesh) ? new Matrix4() : placement(mesh, root));
		this.#pieces = gatherPieces(hanging, axes).map((piece) => {
			const { geometry, material, mesh: own } = piece;
			const posed = poses && isJointed(piece) ? new PosedMaterial(material as Material) : undefined;
			if (piece.thin) keepThin(posed?.material ?? (material as Material), height);
			const mesh = new InstancedMesh(geometry, posed?.material ?? material, 0);
			const places = new Places(capacity);
			mesh.instanceMatrix = places;
			mesh.name = own.name;
			mesh.castShadow = own.castShadow;
			mesh.receiveShadow = own.receiveShadow;
			mesh.frustumCulled = false;
			mesh.boundingSphere = bounds;
			mesh.onBeforeRender = (renderer) => {
				height.value = renderer.getCurrentViewport(viewport).w;
				drawn(height.value);
			};
			if (own.morphTargetInfluences) mesh.morphTargetInfluences = own.morphTargetInfluences;
			if (posed) {
				poses?.carry(mesh as Jointed);
				mesh.customDepthMaterial = posed.depth;
			}
			return { piece, mesh, posed, places, matrices: new Float32Array(capacity * 16) };
		});
	}

	get meshes(): InstancedMesh[] {
		return this.#pieces.map(({ mesh }) => mesh);
	}

	/**
	 * Places a body.
	 *
	 * @param given its axes → the herd's
	 * @param firstJoint of its pose
	 */
	setMatrixAt(i: number, given: Matrix4, firstJoint: number): void {
		for (const { piece, matrices, posed } of this.#pieces) {
			total.multiplyMatrices(given, piece.matrix).toArray(matrices, 16 * i);
			if (posed) matrices[16 * i + 3] = firstJoint;
		}
	}

	/** Draws the first `count` bodies of `drawn`, the last first. @param moved whether the matrices have changed */
	put(drawn: Uint32Array, count: number, moved: boolean): void {
		for (const { piece, mesh, posed, places, matrices } of this.#pieces) {
			piece.follow();
			posed?.follow();
			places.put(drawn, count - 1, -1, count, matrices, moved);
			mesh.count = count;
			mesh.visible = count > 0;
		}
	}

	dispose(): void {
		for (const { geometry } of this.#copies) geometry.dispose();
		for (const { mesh, posed, piece } of this.#pieces) {
			mesh.removeFromParent();
			mesh.dispose();
			posed?.dispose();
			piece.dispose();
		}
	}
}
