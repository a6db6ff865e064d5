/** Skin of a body in a pose, for rays: its vertices are posed once, not at every triangle. */

import {
	BufferAttribute,
	BufferGeometry,
	type Intersection,
	Mesh,
	type Object3D,
	type Raycaster,
	SkinnedMesh,
	Sphere,
} from 'three';
import { PosedVertices } from '../../scene/clips/PosedVertices.ts';

/** A mesh, and its copy in the world where bones and morph targets have brought it. */
interface Piece {
	vertices: PosedVertices;
	copy: Mesh;
}

const isPosed = (mesh: Mesh) => mesh instanceof SkinnedMesh || Boolean(mesh.morphTargetInfluences?.length);

export class PosedSkin {
	readonly #pieces = new WeakMap<Mesh, Piece>();
	readonly #own: Intersection[] = [];

	/**
	 * Finds where a ray meets the skin.
	 *
	 * @param skin a mesh, or a group of some; matrices are up to date
	 * @param hits takes what three's Raycaster finds, nearest first, with normals of the world
	 */
	intersect(caster: Raycaster, skin: Object3D, hits: Intersection[]): void {
		skin.traverse((mesh) => {
			if (!(mesh instanceof Mesh)) return;
			this.#own.length = 0;
			if (isPosed(mesh)) this.#posed(mesh).raycast(caster, this.#own);
			else mesh.raycast(caster, this.#own);
			for (const hit of this.#own) {
				const normal = hit.normal ?? hit.face?.normal;
				if (normal) hit.normal = normal.clone().transformDirection(hit.object.matrixWorld);
				hit.object = mesh;
				hits.push(hit);
			}
		});
		hits.sort((a, b) => a.distance - b.distance);
	}

	#posed(mesh: Mesh): Mesh {
		const piece = this.#pieces.get(mesh) ?? newPiece(mesh);
		this.#pieces.set(mesh, piece);
		piece.vertices.update();
		return piece.copy;
	}
}

function newPiece(mesh: Mesh): Piece {
	const vertices = new PosedVertices(mesh);
	const geometry = new BufferGeometry().setIndex(mesh.geometry.index);
	geometry.setAttribute('position', new BufferAttribute(vertices.places, 3));
	geometry.boundingSphere = new Sphere(undefined, Number.POSITIVE_INFINITY);
	return { vertices, copy: new Mesh(geometry, mesh.material) };
}
