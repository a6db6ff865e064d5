/** The body below the fur: dark where fur shades it, its own colour where it is bare. */

import {
	Box3,
	BufferAttribute,
	type BufferGeometry,
	Color,
	type Mesh,
	type MeshStandardMaterial,
	type Object3D,
	Vector3,
} from 'three';
import type { FurAsset } from './format.ts';

/** Fur shorter than this share of the longest begins to let the skin's own colour through. */
const SHORT = 1 / 8;

/**
 * How much fur stands on each vertex of the skin, 0..1, by the vertices of the shells at the same place.
 *
 * @param skin with positions in the shells' units, to the bit; so each has fur where the shells stand on another, simpler
 * surface and share no vertex with it
 * @returns undefined where fur is all over it
 */
export function furCover(skin: BufferGeometry, shells: BufferGeometry): Float32Array | undefined {
	const fur = shells.getAttribute('_fur');
	const [places, stands] = [skin.getAttribute('position'), shells.getAttribute('position')];
	const key = (position: typeof places, i: number) => [position.getX(i), position.getY(i), position.getZ(i)].join();
	const cover = new Map<string, number>();
	for (let i = 0; i < stands.count; i++) {
		const share = fur ? fur.getX(i) * Math.min(fur.getY(i) / SHORT, 1) : 1;
		const at = key(stands, i);
		cover.set(at, (cover.get(at) ?? 0) + share);
	}
	const found = Array.from({ length: places.count }, (_, i) => cover.get(key(places, i)));
	if (found.every((share) => share === undefined)) return undefined;
	const shares = Float32Array.from(found, (share) => Math.min(share ?? 0, 1));
	return shares.every((share) => share > 0.99) ? undefined : shares;
}

/** How much of the roots' colour the skin shows: it lies in the shadow of all the fur above it. */
const SHADE = 0.35;

const WHITE = new Color(1, 1, 1);

/** A piece of the skin, in a copy of its material that can be darkened where fur stands on it. */
export class ShadedPiece {
	readonly material: MeshStandardMaterial;
	readonly #own: Color | undefined;
	readonly #roughness: number | undefined;
	/** Mean cover. */
	readonly #covered: number;
	/** Of every vertex where it is not all under fur: its own colour, the cover, and what both make. */
	readonly #vertices: { own: Float32Array; cover: Float32Array; shaded: BufferAttribute } | undefined;

	/** @param cover as from `furCover` */
	constructor(piece: Mesh, cover: Float32Array | undefined) {
		const own = piece.material as MeshStandardMaterial;
		this.material = own.clone();
		this.#own = own.color?.clone();
		this.#roughness = own.roughness;
		this.#covered = cover ? cover.reduce((sum, share) => sum + share, 0) / cover.length : 1;
		if (cover) {
			const before = own.vertexColors ? piece.geometry.getAttribute('color') : undefined;
			const colours = Float32Array.from(
				{ length: cover.length * 3 },
				(_, i) => before?.getComponent(Math.floor(i / 3), i % 3) ?? 1,
			);
			this.#vertices = { own: colours, cover, shaded: new BufferAttribute(colours.slice(), 3) };
			piece.geometry.setAttribute('color', this.#vertices.shaded);
			this.material.vertexColors = true;
		}
		piece.material = this.material;
	}

	/** @param fur how bright it is under fur, of its own colour; undefined: there is no fur */
	shade(fur: Color | undefined): void {
		// What lies below fur does not shine through it.
		if (this.#roughness !== undefined)
			this.material.roughness = this.#roughness + (fur ? (1 - this.#roughness) * this.#covered : 0);
		const shade = fur ?? WHITE;
		if (!this.#vertices) {
			if (this.#own) this.material.color.copy(this.#own).multiply(shade);
			return;
		}
		const { own, cover, shaded } = this.#vertices;
		for (const [c, share] of shade.toArray().entries())
			for (let i = c; i < own.length; i += 3)
				shaded.array[i] = (own[i] as number) * (1 + (share - 1) * (cover[(i - c) / 3] as number));
		shaded.needsUpdate = true;
	}
}

/** The skin of a body whose furs take turns: as dark as under the one that was put on last, and as bright as it is under none. */
export class Skin {
	/** Largest side of the box around it, model units. */
	readonly extent: number;
	readonly #meshes: readonly Mesh[];
	readonly #pieces: readonly ShadedPiece[];
	/** Furs that are seen, the last one put on at the end, and how dark it is under them. */
	readonly #worn = new Map<FurAsset, Color>();

	/**
	 * @param object a mesh, or a group of one for each material
	 * @param surface what the shells stand on, if its axes are the skin's
	 */
	constructor(
		readonly object: Object3D,
		meshes: readonly Mesh[],
		surface: BufferGeometry | undefined,
	) {
		this.#meshes = meshes;
		this.#pieces = meshes.map((mesh) => new ShadedPiece(mesh, surface && furCover(mesh.geometry, surface)));
		const box = new Box3();
		for (const mesh of meshes) {
			mesh.castShadow = mesh.receiveShadow = true;
			mesh.geometry.computeBoundingBox();
			const own = mesh.geometry.boundingBox?.clone().applyMatrix4(mesh.matrix);
			if (own) box.union(mesh === object ? own : own.applyMatrix4(object.matrix));
		}
		this.extent = Math.max(...box.getSize(new Vector3()).toArray());
	}

	/** Has it lie under this fur. */
	cover(fur: FurAsset): void {
		this.#worn.delete(fur);
		this.#worn.set(fur, new Color(...fur.ramp.root).multiplyScalar(SHADE));
		this.#shade();
	}

	/** Takes a fur away. */
	bare(fur: FurAsset): void {
		this.#worn.delete(fur);
		this.#shade();
	}

	#shade(): void {
		const shade = [...this.#worn.values()].at(-1);
		for (const piece of this.#pieces) piece.shade(shade);
	}

	dispose(): void {
		for (const { material } of this.#pieces) material.dispose();
		for (const { geometry } of this.#meshes) geometry.dispose();
	}
}
