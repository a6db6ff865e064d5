/** The body below the fur: dark where fur shades it, its own colour where it is bare. */

import {
	Box3,
	BufferAttribute,
	BufferGeometry,
	Color,
	type Mesh,
	type MeshStandardMaterial,
	type Object3D,
	Vector3,
} from 'three';
import type { Follicles } from './follicles.ts';
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

/** Brightness of the skin under soaked fur over that under dry fur. */
const SOAKED = 0.5;

const WHITE = new Color(1, 1, 1);

/** How wet the fur of a body is. */
export interface Wetness {
	follicles: Follicles;
	/** 0..1 */
	at(follicle: number): number;
}

/** Of every vertex its own colour, the cover, and what both make. */
interface Vertices {
	own: Float32Array;
	cover: Float32Array;
	shaded: BufferAttribute;
}

/** A piece of the skin, in a copy of its material that can be darkened where fur stands on it. */
export class ShadedPiece {
	readonly material: MeshStandardMaterial;
	readonly #own: Color | undefined;
	readonly #roughness: number | undefined;
	/** Mean cover. */
	readonly #covered: number;
	readonly #piece: Mesh;
	/** Whether its vertices have colours of their own. */
	readonly #coloured: boolean;
	/** Whether some of it is bare. */
	readonly #bare: boolean;
	/** Where some are bare, or were wet. */
	#vertices: Vertices | undefined;
	/** The follicle at each vertex. */
	#follicle: ArrayLike<number> | undefined;

	/** @param cover as from `furCover` */
	constructor(piece: Mesh, cover: Float32Array | undefined) {
		this.#piece = piece;
		const own = piece.material as MeshStandardMaterial;
		this.material = own.clone();
		this.#own = own.color?.clone();
		this.#roughness = own.roughness;
		this.#covered = cover ? cover.reduce((sum, share) => sum + share, 0) / cover.length : 1;
		this.#coloured = own.vertexColors;
		this.#bare = cover !== undefined;
		if (cover) this.#colour(cover);
		piece.material = this.material;
	}

	/** Gives each vertex a colour; it keeps it, seen or not. */
	#colour(cover: Float32Array): void {
		const { geometry } = this.#piece;
		const before = this.#coloured ? geometry.getAttribute('color') : undefined;
		const own = Float32Array.from(
			{ length: cover.length * 3 },
			(_, i) => before?.getComponent(Math.floor(i / 3), i % 3) ?? 1,
		);
		this.#vertices = { own, cover, shaded: new BufferAttribute(own.slice(), 3) };
		geometry.setAttribute('color', this.#vertices.shaded);
	}

	/**
	 * @param fur how bright it is under fur, of its own colour; undefined: there is no fur
	 * @param wetness of that fur, undefined: dry
	 */
	shade(fur: Color | undefined, wetness?: Wetness): void {
		// What lies below fur does not shine through it.
		if (this.#roughness !== undefined)
			this.material.roughness = this.#roughness + (fur ? (1 - this.#roughness) * this.#covered : 0);
		const shade = fur ?? WHITE;
		const each = this.#bare || wetness !== undefined;
		if (each && !this.#vertices)
			this.#colour(new Float32Array(this.#piece.geometry.getAttribute('position').count).fill(1));
		const coloured = each || this.#coloured;
		if (this.material.vertexColors !== coloured) {
			this.material.vertexColors = coloured;
			this.material.needsUpdate = true;
		}
		if (this.#own) this.material.color.copy(this.#own).multiply(each ? WHITE : shade);
		if (this.#vertices) this.#paint(this.#vertices, each ? shade : WHITE, wetness);
	}

	#paint(vertices: Vertices, shade: Color, wetness: Wetness | undefined): void {
		const { own, cover, shaded } = vertices;
		const at = wetness && this.#follicles(wetness.follicles);
		for (let v = 0; v < cover.length; v++) {
			const wet = wetness && at ? 1 + (SOAKED - 1) * wetness.at(at[v] as number) : 1;
			for (let c = 0; c < 3; c++) {
				const share = wet * (c === 0 ? shade.r : c === 1 ? shade.g : shade.b);
				shaded.array[3 * v + c] = (own[3 * v + c] as number) * (1 + (share - 1) * (cover[v] as number));
			}
		}
		shaded.needsUpdate = true;
	}

	#follicles(follicles: Follicles): ArrayLike<number> {
		if (!this.#follicle) {
			// Beside the skin: what is asked of its own geometry is what it looks like.
			const stands = new BufferGeometry();
			for (const name of ['position', 'normal']) stands.setAttribute(name, this.#piece.geometry.getAttribute(name));
			follicles.mark(stands);
			this.#follicle = stands.getAttribute('follicle').array;
		}
		return this.#follicle;
	}
}

/** The skin of a body whose furs take turns: as dark as under the one that was put on last, and as bright as it is under none. */
export class Skin {
	/** Largest side of the box around it, model units. */
	readonly extent: number;
	readonly #meshes: readonly Mesh[];
	readonly #pieces: readonly ShadedPiece[];
	/** Furs that are seen, the last one put on at the end, and how dark it is under them. */
	readonly #worn = new Map<FurAsset, { shade: Color; wetness: Wetness | undefined }>();
	/** Whether it knows where the shells stand. */
	readonly #under: boolean;

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
		this.#under = surface !== undefined;
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

	/** Has it lie under this fur. @param wetness of the fur, undefined: dry */
	cover(fur: FurAsset, wetness?: Wetness): void {
		this.#worn.delete(fur);
		this.#worn.set(fur, { shade: new Color(...fur.ramp.root).multiplyScalar(SHADE), wetness });
		this.#shade();
	}

	/** Has this fur, if it lies under it, be as wet. */
	soak(fur: FurAsset, wetness: Wetness | undefined): void {
		const worn = this.#worn.get(fur);
		if (!worn || (!worn.wetness && !wetness)) return;
		worn.wetness = wetness;
		this.#shade();
	}

	/** Takes a fur away. */
	bare(fur: FurAsset): void {
		this.#worn.delete(fur);
		this.#shade();
	}

	#shade(): void {
		const { shade, wetness } = [...this.#worn.values()].at(-1) ?? {};
		for (const piece of this.#pieces) piece.shade(shade, this.#under ? wetness : undefined);
	}

	dispose(): void {
		for (const { material } of this.#pieces) material.dispose();
		for (const { geometry } of this.#meshes) geometry.dispose();
	}
}
