/** Vertices of a mesh where bones and morph targets have brought them. */

import { type BufferAttribute, Matrix4, type Mesh, SkinnedMesh, Vector3 } from 'three';

const vertex = new Vector3();
const bone = new Matrix4();

/** Attribute of some vertices as numbers. */
function taken(attribute: BufferAttribute, vertices: ArrayLike<number>): Float32Array {
	const { itemSize } = attribute;
	const values = new Float32Array(vertices.length * itemSize);
	for (let i = 0; i < vertices.length; i++)
		for (let c = 0; c < itemSize; c++) values[i * itemSize + c] = attribute.getComponent(vertices[i] as number, c);
	return values;
}

export class PosedVertices {
	/** Positions as stored, in the mesh's units. */
	readonly rest: Float32Array;
	/** Places of the last `update`, world. */
	readonly places: Float32Array;
	readonly #base: Float32Array;
	readonly #targets: readonly Float32Array[];
	readonly #joints: Float32Array | undefined;
	readonly #weights: Float32Array | undefined;
	/** A matrix per bone: from the mesh's units to the world. */
	#bones = new Float32Array(0);

	/** @param vertices of the mesh; all by default */
	constructor(
		readonly mesh: Mesh,
		vertices?: ArrayLike<number>,
	) {
		const { attributes, morphAttributes, morphTargetsRelative } = mesh.geometry;
		const position = attributes.position as BufferAttribute;
		const chosen = vertices ?? Uint32Array.from({ length: position.count }, (_, i) => i);
		const of = (attribute: unknown) => taken(attribute as BufferAttribute, chosen);
		this.rest = of(position);
		this.#base = this.rest.slice();
		this.places = new Float32Array(this.rest.length);
		this.#targets = (morphAttributes.position ?? []).map(of);
		for (const target of morphTargetsRelative ? [] : this.#targets)
			for (let i = 0; i < target.length; i++) target[i] = (target[i] as number) - (this.rest[i] as number);
		if (!(mesh instanceof SkinnedMesh)) return;
		this.#joints = of(attributes.skinIndex);
		this.#weights = of(attributes.skinWeight);
	}

	/** Brings the places to the present pose; matrices of bones and mesh are up to date. */
	update(): Float32Array {
		const { mesh } = this;
		this.#base.set(this.rest);
		this.#targets.forEach((target, t) => {
			const share = mesh.morphTargetInfluences?.[t] ?? 0;
			if (share === 0) return;
			for (let i = 0; i < target.length; i++) this.#base[i] = (this.#base[i] as number) + share * (target[i] as number);
		});
		if (this.#joints && this.#weights) this.#blend(mesh as SkinnedMesh, this.#joints, this.#weights);
		else
			for (let i = 0; i < this.places.length; i += 3)
				vertex.fromArray(this.#base, i).applyMatrix4(mesh.matrixWorld).toArray(this.places, i);
		return this.places;
	}

	#blend({ skeleton, bindMatrix }: SkinnedMesh, joints: Float32Array, weights: Float32Array): void {
		const { bones, boneInverses } = skeleton;
		if (this.#bones.length !== 16 * bones.length) this.#bones = new Float32Array(16 * bones.length);
		const matrices = this.#bones;
		bones.forEach((joint, j) => {
			bone.multiplyMatrices(joint.matrixWorld, boneInverses[j] as Matrix4).multiply(bindMatrix);
			bone.toArray(matrices, 16 * j);
		});
		const at = (index: number) => matrices[index] as number;
		for (let v = 0; 3 * v < this.places.length; v++) {
			const [x, y, z] = [this.#base[3 * v], this.#base[3 * v + 1], this.#base[3 * v + 2]] as [number, number, number];
			let [px, py, pz] = [0, 0, 0];
			for (let k = 4 * v; k < 4 * v + 4; k++) {
				const weight = weights[k] as number;
				if (weight === 0) continue;
				const m = 16 * (joints[k] as number);
				px += weight * (at(m) * x + at(m + 4) * y + at(m + 8) * z + at(m + 12));
				py += weight * (at(m + 1) * x + at(m + 5) * y + at(m + 9) * z + at(m + 13));
				pz += weight * (at(m + 2) * x + at(m + 6) * y + at(m + 10) * z + at(m + 14));
			}
			this.places[3 * v] = px;
			this.places[3 * v + 1] = py;
			this.places[3 * v + 2] = pz;
		}
	}
}
