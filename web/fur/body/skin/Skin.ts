/** Skin below the fur: dark where fur shades it, in its own colour where bare. */

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
import type { FurAsset } from '../../format.ts';
import type { FurFollicles } from '../FurFollicles.ts';
import type { FurPose } from '../FurPose.ts';
import { shareGeometry, unshareGeometry } from '../shareGeometry.ts';
import { furCover, standsOn } from './furCover.ts';
import { MatteMaterial } from './MatteMaterial.ts';

/** Share of the roots' colour that the skin shows in the shadow of its fur. */
const SHADE = 0.35;

/** Brightness of the skin under soaked fur over that under dry fur. */
const SOAKED = 0.5;

const WHITE = new Color(1, 1, 1);

/** Wetness of a body's fur. */
export interface Wetness {
	follicles: FurFollicles;
	/** 0..1 */
	at(follicle: number): number;
}

/** Own colour, cover and resulting colour of every vertex. */
interface Vertices {
	own: Float32Array;
	cover: Float32Array;
	shaded: BufferAttribute;
}

/** Piece of the skin, with a copy of its material that is darkened below fur. */
export class ShadedPiece {
	readonly material: MeshStandardMaterial;
	/** Material as loaded. */
	readonly #plain: MeshStandardMaterial;
	/** Colours of the vertices as loaded. */
	#colours: ReturnType<BufferGeometry['getAttribute']> | undefined;
	readonly #own: Color | undefined;
	readonly #roughness: number | undefined;
	/** Mean cover. */
	readonly #covered: number;
	readonly #piece: Mesh;
	/** Whether its vertices have colours of their own. */
	readonly #coloured: boolean;
	/** Whether some of it is bare. */
	readonly #bare: boolean;
	/** Present where some vertices are bare or were wet. */
	#vertices: Vertices | undefined;
	/** The follicle at each vertex. */
	#follicle: ArrayLike<number> | undefined;

	/** @param cover as from `furCover` */
	constructor(piece: Mesh, cover: Float32Array | undefined) {
		this.#piece = piece;
		const own = piece.material as MeshStandardMaterial;
		this.#plain = own;
		this.#colours = piece.geometry.attributes.color;
		this.material = MatteMaterial.of(own);
		this.#own = own.color?.clone();
		this.#roughness = own.roughness;
		this.#covered = cover ? cover.reduce((sum, share) => sum + share, 0) / cover.length : 1;
		this.#coloured = own.vertexColors;
		this.#bare = cover !== undefined;
		if (cover) this.#colour(cover);
		piece.material = this.material;
	}

	/** Gives a copy of the piece an unshaded look and a geometry of its own, of the same vertices. */
	undress(copy: Mesh): void {
		copy.material = this.#plain;
		copy.geometry = shareGeometry(this.#piece.geometry);
		if (this.#colours) copy.geometry.setAttribute('color', this.#colours);
		else copy.geometry.deleteAttribute('color');
	}

	/** Give each vertex a colour, for good. */
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
	 * @param fur brightness under fur, share of its own colour; undefined: no fur
	 * @param wetness of that fur; undefined: dry
	 */
	shade(fur: Color | undefined, wetness?: Wetness): void {
		// Skin below fur has no highlights.
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

	#follicles(follicles: FurFollicles): ArrayLike<number> {
		if (!this.#follicle) {
			// On a separate geometry: the skin's own gets no attribute.
			const stands = new BufferGeometry();
			for (const name of ['position', 'normal']) stands.setAttribute(name, this.#piece.geometry.getAttribute(name));
			follicles.mark(stands);
			this.#follicle = stands.getAttribute('follicle').array;
		}
		return this.#follicle;
	}
}

/** `FurPose.of`, which bodies without joints and targets need not fetch. */
type PoseOf = typeof FurPose.of;

/** Skins by their objects. */
const known = new WeakMap<Object3D, Skin>();

/** Skin of a body with one fur or several in turn: shaded by the one shown last, unshaded without any. */
export class Skin {
	/** Largest side of the box around it, model units. */
	readonly extent: number;
	/** Pose of the body; undefined for one that has no joints and no morph targets. */
	readonly pose: FurPose | undefined;
	readonly #meshes: readonly Mesh[];
	readonly #pieces: readonly ShadedPiece[];
	/** Visible furs, the one shown last at the end, with the shade below each. */
	readonly #visible = new Map<FurAsset, { shade: Color; wetness: Wetness | undefined }>();
	/** Geometry of the shells, if its axes are the skin's. */
	readonly #surface: BufferGeometry | undefined;
	readonly #poseOf: PoseOf | undefined;

	/**
	 * @param object a mesh, or a group of one for each material
	 * @param surface geometry of the shells, if its axes are the skin's
	 * @param poseOf undefined: nothing moves
	 */
	constructor(
		readonly object: Object3D,
		meshes: readonly Mesh[],
		surface: BufferGeometry | undefined,
		poseOf?: PoseOf,
	) {
		this.#meshes = meshes;
		this.#surface = surface;
		this.#poseOf = poseOf;
		this.pose = poseOf?.(meshes);
		known.set(object, this);
		const apart = surface && !standsOn(this.geometries, surface);
		this.#pieces = meshes.map((mesh) => new ShadedPiece(mesh, surface && furCover(mesh.geometry, surface, apart)));
		const box = new Box3();
		for (const mesh of meshes) {
			mesh.castShadow = mesh.receiveShadow = true;
			// At rest, without morph targets.
			const points = new BufferGeometry().setAttribute('position', mesh.geometry.getAttribute('position'));
			points.computeBoundingBox();
			const own = points.boundingBox?.applyMatrix4(mesh.matrix);
			if (own) box.union(mesh === object ? own : own.applyMatrix4(object.matrix));
		}
		this.extent = Math.max(...box.getSize(new Vector3()).toArray());
	}

	/** Shade it below this fur. @param wetness of the fur; undefined: dry */
	cover(fur: FurAsset, wetness?: Wetness): void {
		this.#visible.delete(fur);
		this.#visible.set(fur, { shade: new Color(...fur.ramp.root).multiplyScalar(SHADE), wetness });
		this.#shade();
	}

	/** Change the wetness of this fur, if it is on. */
	soak(fur: FurAsset, wetness: Wetness | undefined): void {
		const shaded = this.#visible.get(fur);
		if (!shaded || (!shaded.wetness && !wetness)) return;
		shaded.wetness = wetness;
		this.#shade();
	}

	/** Remove a fur. */
	bare(fur: FurAsset): void {
		this.#visible.delete(fur);
		this.#shade();
	}

	#shade(): void {
		const { shade, wetness } = [...this.#visible.values()].at(-1) ?? {};
		for (const piece of this.#pieces) piece.shade(shade, this.#surface ? wetness : undefined);
	}

	/** Geometries of its pieces. */
	get geometries(): BufferGeometry[] {
		return this.#meshes.map(({ geometry }) => geometry);
	}

	/**
	 * Skin of a copy of the object, made by three's `clone`.
	 *
	 * @returns undefined where it is no copy
	 */
	of(copy: Object3D | undefined): Skin | undefined {
		if (!copy || copy === this.object) return undefined;
		const before = known.get(copy);
		if (before) return before;
		const meshes = (this.object === this.#meshes[0] ? [copy] : copy.children) as Mesh[];
		if (!this.#meshes.every(({ geometry }, i) => meshes[i]?.geometry === geometry)) return undefined;
		for (const [i, piece] of this.#pieces.entries()) piece.undress(meshes[i] as Mesh);
		return new Skin(copy, meshes, this.#surface, this.#poseOf);
	}

	/** @param others geometries that keep attributes; undefined: all belong to this skin alone */
	dispose(others: readonly BufferGeometry[] = []): void {
		this.pose?.release();
		known.delete(this.object);
		for (const geometry of this.geometries) unshareGeometry(geometry, others);
		for (const { material } of this.#pieces) material.dispose();
		for (const { geometry } of this.#meshes) geometry.dispose();
	}
}
