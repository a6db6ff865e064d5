import {
	BufferAttribute,
	type BufferGeometry,
	type InterleavedBufferAttribute,
	Matrix4,
	Mesh,
	type Object3D,
	Sphere,
	Vector3,
	type WebGLRenderer,
} from 'three';
import { beginClip, type Columns, endClip } from './clip.ts';
import type { FinMaterial } from './FinMaterial.ts';
import type { FurMaterial } from './FurMaterial.ts';

/**
 * The fins of a furry surface: one draw, before the shells.
 *
 * The renderer sorts what is transparent by the distance of its bounding sphere, and what is equally far by age. So fins
 * are made before their shells and then take their place and their sphere, to the bit.
 */
export class FurFins extends Mesh<BufferGeometry, FinMaterial> {
	/** Columns of the picture in which they are drawn; undefined: all. */
	clip: Columns | undefined;

	/**
	 * @param quads four vertices per edge with position (on the skin), normal, tangent (along the edge), uv (tiles along
	 * the edge, height 0..1), _edge and _fur
	 */
	constructor(quads: BufferGeometry, material: FinMaterial) {
		super(quads, material);
		this.name = 'fins';
		this.receiveShadow = true;
	}

	/**
	 * Takes the place of the shells.
	 *
	 * @param shells the shells that are drawn over these fins
	 * @param placement the node whose transform takes the quads' units to the model's
	 */
	join(shells: Mesh<BufferGeometry, FurMaterial>, placement: Object3D): void {
		for (const object of [shells, placement]) object.updateMatrix();
		if (!placement.matrix.equals(shells.matrix)) {
			const between = new Matrix4().copy(shells.matrix).invert().multiply(placement.matrix);
			this.geometry.setAttribute('position', transformed(this.geometry.getAttribute('position'), between));
		}
		this.position.copy(shells.position);
		this.quaternion.copy(shells.quaternion);
		this.scale.copy(shells.scale);
		this.fit(shells);
	}

	/** Takes the shells' sphere, anew where their fur has another length. */
	fit(shells: Mesh<BufferGeometry, FurMaterial>): void {
		const { center, radius } = shells.geometry.boundingSphere ?? new Sphere(new Vector3(), Number.POSITIVE_INFINITY);
		const longer = Math.max(this.material.finLength - 1, 0) * shells.material.furLength;
		this.geometry.boundingSphere = new Sphere(center.clone(), radius + longer);
	}

	/** In the columns that are the fur's. */
	override onBeforeRender(renderer: WebGLRenderer): void {
		beginClip(renderer, this.clip);
	}

	/** Other objects have the whole picture. */
	override onAfterRender(renderer: WebGLRenderer): void {
		endClip(renderer, this.clip);
	}

	/** Frees the geometry; material and textures belong to the whole fur. */
	override dispose(): void {
		super.dispose();
		this.geometry.dispose();
	}
}

function transformed(position: BufferAttribute | InterleavedBufferAttribute, matrix: Matrix4): BufferAttribute {
	const moved = new BufferAttribute(new Float32Array(position.count * 3), 3);
	const vertex = new Vector3();
	for (let i = 0; i < position.count; i++) {
		vertex
			.fromBufferAttribute(position, i)
			.applyMatrix4(matrix)
			.toArray(moved.array, i * 3);
	}
	return moved;
}
