import {
	BufferAttribute,
	BufferGeometry,
	type InterleavedBufferAttribute,
	Matrix4,
	Mesh,
	type Object3D,
	Sphere,
	Vector3,
	type WebGLRenderer,
} from 'three';
import { BodyCurvature } from '../body/BodyCurvature.ts';
import { beginClip, endClip, type FurColumns } from './clip.ts';
import type { FurFinMaterial } from './FurFinMaterial.ts';
import type { FurMaterial } from './FurMaterial.ts';

/** Strips per fin where light changes with the height. */
const STRIPS = 4;

/**
 * The fins of a furry surface: one draw, before the shells.
 *
 * The renderer sorts transparent objects by the distance of their bounding spheres, then by age. So fins are created before
 * their shells and share placement and sphere with them, to the bit.
 */
export class FurFins extends Mesh<BufferGeometry, FurFinMaterial> {
	/** Columns of the picture to draw; undefined: all. */
	clip: FurColumns | undefined;

	/**
	 * @param quads four vertices per edge with position (on the skin), normal, tangent (along the edge), uv (tiles along
	 * the edge, height 0..1), _edge and _fur
	 */
	constructor(quads: BufferGeometry, material: FurFinMaterial) {
		super(material.means ? cutFins(quads, STRIPS) : quads, material);
		this.name = 'fins';
		this.receiveShadow = true;
	}

	/**
	 * Joins the shells, sharing their placement.
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
		if (this.material.means) BodyCurvature.of(shells.geometry).mark(this.geometry, -1);
		this.fit(shells);
	}

	/** Copies the shells' bounding sphere; call again when the length changes. */
	fit(shells: Mesh<BufferGeometry, FurMaterial>): void {
		const { center, radius } = shells.geometry.boundingSphere ?? new Sphere(new Vector3(), Number.POSITIVE_INFINITY);
		const longer = Math.max(this.material.finLength - 1, 0) * shells.material.furLength;
		this.geometry.boundingSphere = new Sphere(center.clone(), radius + longer);
	}

	/** Restrict the draw to `clip`. */
	override onBeforeRender(renderer: WebGLRenderer): void {
		beginClip(renderer, this.clip);
	}

	/** Restore the scissor. */
	override onAfterRender(renderer: WebGLRenderer): void {
		endClip(renderer, this.clip);
	}

	/** Frees the geometry; material and textures belong to the fur. */
	override dispose(): void {
		super.dispose();
		this.geometry.dispose();
	}
}

/**
 * Cuts fins into strips from root to tip, so that light follows the height.
 *
 * @param quads four vertices per edge: root, root, tip, tip, first end before second
 */
export function cutFins(quads: BufferGeometry, strips: number): BufferGeometry {
	if (quads.userData.strips === strips) return quads;
	const cut = new BufferGeometry();
	const rows = strips + 1;
	const edges = quads.getAttribute('position').count / 4;
	for (const [name, attribute] of Object.entries(quads.attributes)) {
		const { itemSize } = attribute;
		const values = new Float32Array(edges * rows * 2 * itemSize);
		for (let vertex = 0, at = 0; vertex < edges * rows * 2; vertex++) {
			const share = (Math.floor(vertex / 2) % rows) / strips;
			const root = 4 * Math.floor(vertex / (2 * rows)) + (vertex % 2);
			for (let c = 0; c < itemSize; c++, at++)
				values[at] = attribute.getComponent(root, c) * (1 - share) + attribute.getComponent(root + 2, c) * share;
		}
		cut.setAttribute(name, new BufferAttribute(values, itemSize));
	}
	const corners = Array.from({ length: edges * strips }, (_, i) => {
		const first = 2 * (Math.floor(i / strips) * rows + (i % strips));
		return [first, first + 1, first + 3, first, first + 3, first + 2];
	});
	cut.setIndex(corners.flat());
	cut.userData.strips = strips;
	return cut;
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
