import type { Intersection, Object3D, Sphere, Texture, Vector3 } from 'three';
import type { FurMethod } from './baselines/furMethod.ts';
import { Bending } from './body/Bending.ts';
import { FurFollicles } from './body/FurFollicles.ts';
import { FurParts } from './body/FurParts.ts';
import type { FurPose } from './body/FurPose.ts';
import { restPoint } from './body/joints/restPoint.ts';
import { type Owned, Sharers } from './body/Sharers.ts';
import { shareGeometry } from './body/shareGeometry.ts';
import type { FurAsset, Pelt } from './format.ts';
import type { FurTextures } from './light/texels.ts';
import type { FurMotion } from './motion/FurMotion.ts';
import type { PeltStates } from './planes/PeltStates.ts';
import type { FurColumns } from './shells/clip.ts';
import type { FurFins } from './shells/FurFins.ts';
import { FurMaterial } from './shells/FurMaterial.ts';
import { FurShells } from './shells/FurShells.ts';
import type { Ground } from './shells/Ground.ts';
import { copyLook } from './shells/look.ts';
import { setMorphs, writeMorphs } from './shells/parts/morphs.ts';
import { type FurStates, Staining } from './shells/Staining.ts';
import { updateFurs } from './updateFurs.ts';
import type { FurWeather } from './weather/FurWeather.ts';

export type { FurStates, Ground };

/** Furs by their parts. */
const furs = new WeakMap<Object3D, Fur>();

/** Shells, fins and the shade of the skin below them: `gltf.userData.fur` of a loaded asset, or made by `dressFur`. */
export class Fur {
	/** The extension's object in its file. */
	readonly asset: FurAsset;
	/** Textures of the shells. */
	readonly textures: FurTextures;
	/** Textures of the fins, if any. */
	readonly finTextures: FurTextures | undefined;
	/** The shells' own material, whatever method lights them. */
	readonly material: FurMaterial;
	/** Drawn in the scene beside the skin. */
	readonly shells: FurShells;
	/** The outline, drawn before the shells. Optional: `fins.visible = false` leaves the shells. */
	readonly fins: FurFins | undefined;
	/** The body: a mesh, or a group of one for each material. */
	readonly skin: Object3D;
	/** Surfaces below the fur, for `dressFur`. */
	readonly ground: Ground;
	/** Textures and their states, for `dressFur`. */
	readonly pelt: PeltStates;
	/** Method applied to the shells by `FurMethod.apply`, if any. */
	method: FurMethod | undefined;
	readonly #parts: FurParts;
	readonly #pose: FurPose | undefined;
	readonly #sharers: Sharers;
	readonly #bending = new Bending<FurMotion>(this);
	readonly #staining: Staining;
	#clip: FurColumns | undefined;
	/** Argument of `updateFurs`, made once. */
	readonly #itself = [this];

	/**
	 * @param owned what is this fur's and its copies', to be freed with the last of them
	 * @param copied fur that this one is a copy of, and the group that takes its parts
	 */
	constructor(asset: FurAsset, pelt: PeltStates, ground: Ground, owned: Owned, copied?: { of: Fur; parts: FurParts }) {
		const [{ textures }, fins] = pelt.cuts;
		const finTextures = fins?.textures;
		const { skin, surface, placement, quads, quadPlacement, colour } = ground;
		// Joints of a pelt's own body move no other surface.
		const pose = surface.hasAttribute('skinIndex') || skin.pose?.morphsOf(surface) ? skin.pose : undefined;
		this.#pose = pose;
		const { fin } = asset.pelts[0] as Pelt;
		this.asset = asset;
		this.pelt = pelt;
		this.textures = textures;
		this.finTextures = finTextures;
		this.ground = ground;
		this.skin = skin.object;
		this.material = new FurMaterial(asset, textures, { skinColor: colour.clone() }, ground.roots);
		setMorphs(this.material, surface, pose);
		if (fin && quads && finTextures)
			this.fins = ground.growFins?.({ ...ground, quads }, fin, finTextures, this.material, pose);
		this.shells = new FurShells(surface, placement, asset, this.material, pose);
		this.fins?.join(this.shells, quadPlacement ?? this.shells);
		if (this.fins) setMorphs(this.fins.material, this.fins.geometry, pose);
		this.#parts = copied?.parts ?? new FurParts();
		this.#sharers = copied ? copied.of.#sharers : new Sharers(owned);
		this.#sharers.add(this);
		for (const part of [this.fins, this.shells]) if (part) this.#parts.add(part);
		if (!copied) this.skin.parent?.add(this.#parts);
		this.#parts.owner = { skin: this.skin, copyTo: this.#copyTo, follow: this.#follow };
		furs.set(this.#parts, this);
		skin.cover(asset);
		this.#staining = new Staining(this);
	}

	/**
	 * Fur of a character: that of a loaded scene, or of a copy by `clone` of three's SkeletonUtils, which is a fur of its own.
	 *
	 *     const twin = SkeletonUtils.clone(gltf.scene);
	 *     const fur = Fur.of(twin);
	 *
	 * @param object scene or a group with the character in it; of several furs, the first visible one
	 */
	static of(object: Object3D): Fur | undefined {
		const found: Fur[] = [];
		object.traverse((part) => {
			const fur = furs.get(part);
			if (fur) found.push(fur);
		});
		return found.find(({ visible }) => visible) ?? found[0];
	}

	/** Become a fur of a copy of this body. */
	readonly #copyTo = (parts: FurParts, candidate: Object3D | undefined): void => {
		const skin = this.ground.skin.of(candidate);
		if (!skin) return;
		const quads = this.fins && shareGeometry(this.fins.geometry);
		const ground = { ...this.ground, skin, surface: this.shells.geometry, quads, quadPlacement: undefined };
		const copy = new Fur(this.asset, this.pelt, ground, 'nothing', { of: this, parts });
		copyLook(this, copy);
		if (!this.visible) copy.visible = false;
	};

	/** Take the pose of the skin. */
	readonly #follow = (): void => {
		const pose = this.#pose;
		if (!pose) return;
		pose.update(this.shells, this.shells.geometry);
		writeMorphs(this.material, pose);
		this.shells.fit(pose);
		this.fins?.fit(this.shells);
	};

	/**
	 * Sphere around body and fur in their present pose, world. World matrices of the joints are updated for it.
	 *
	 * @param target takes the result
	 */
	bounds(target: Sphere): Sphere {
		const { shells, fins } = this;
		shells.updateWorldMatrix(true, false);
		this.#pose?.refresh();
		this.#follow();
		const sphere = (fins ?? shells).geometry.boundingSphere;
		return sphere ? target.copy(sphere).applyMatrix4(shells.matrixWorld) : target.makeEmpty();
	}

	/**
	 * Place on the body at rest of a point where a ray has met its skin in a pose: paint weather and stroke there.
	 *
	 * @param hit from three's Raycaster, of this fur's skin
	 * @param target takes the place, world; on a body without a pose that is where the ray has met it
	 */
	restPoint(hit: Intersection, target: Vector3): Vector3 {
		return restPoint(hit, target);
	}

	/** Whether shells and fins are drawn and the skin is shaded. Of several furs of a body, the one shown last shades the skin. */
	get visible(): boolean {
		return this.#parts.visible;
	}

	set visible(on: boolean) {
		this.#parts.visible = on;
		if (on) this.ground.skin.cover(this.asset, this.#staining.wetness());
		else this.ground.skin.bare(this.asset);
	}

	/**
	 * Advances motion, weather and a method's maps by a frame. Call it once per frame, before drawing, for one fur of a body;
	 * for several bodies see `updateFurs`.
	 *
	 * @param seconds since the last frame; 0 shows changed settings without advancing
	 * @returns whether the picture changes
	 */
	update(seconds: number): boolean {
		return updateFurs(this.#itself, seconds);
	}

	/** Longest side of the box around the bare body at rest, model units. */
	get extent(): number {
		return this.ground.skin.extent;
	}

	/**
	 * Length of the longest hairs, model units; 0.1 to 2 times `asset.length`, the baked one. Shorter hairs are cut, longer
	 * ones are stretched.
	 */
	get length(): number {
		return this.shells.furLength;
	}

	set length(length: number) {
		if (!(length >= 0)) throw new RangeError(`fur.length: got ${length}, expected 0 or more`);
		this.material.trim = Math.min(length / this.asset.length, 1);
		this.shells.furLength = length;
		this.fins?.fit(this.shells);
	}

	/**
	 * Points of the skin by which hairs move, get wet and get dirty; shared by all furs of a body. The first access gives
	 * shells and fins the attribute `follicle`.
	 */
	get follicles(): FurFollicles {
		return this.#mark();
	}

	/** Springs of the hairs; undefined: as baked. Furs of one body may share it. */
	get motion(): FurMotion | undefined {
		return this.#bending.motion;
	}

	set motion(motion: FurMotion | undefined) {
		this.#bending.motion = motion;
	}

	/**
	 * Displacement of hairs beyond their comb: RGBA floats, a texel per follicle, XYZ = displacement of the tip in the
	 * tangent plane, share of the length, axes of the shells' mesh; with the comb no longer than 0.8. A writer on the GPU adds
	 * 1 to the texture's `version`. Undefined means as baked, and costs nothing; disposing of the texture sets it back to that.
	 * Attached motion sets it.
	 */
	get swing(): Texture | undefined {
		return this.material.swing;
	}

	set swing(texture: Texture | undefined) {
		if (texture === this.swing) return;
		if (texture) this.#mark();
		this.#bending.show(texture);
	}

	/**
	 * Columns of the picture in which shells and fins are drawn; undefined: all. Lets two furs of a body, lit differently,
	 * share one render of the scene.
	 */
	get clip(): FurColumns | undefined {
		return this.#clip;
	}

	set clip(columns: FurColumns | undefined) {
		this.#clip = columns;
		for (const part of [this.fins, this.shells]) if (part) part.clip = columns;
	}

	#mark(): FurFollicles {
		const follicles = FurFollicles.of(this.shells.geometry);
		for (const part of [this.fins, this.shells]) if (part) follicles.mark(part.geometry);
		return follicles;
	}

	/** States in the file beside dry, clean fur; shown once `loadStates` has loaded them. */
	get states(): FurStates {
		const { wet, dirty } = this.pelt.all;
		return { wet: wet.length > 1, dirt: dirty !== undefined };
	}

	/**
	 * Fetches and decodes the pelt's wet and dirty states in small steps; once, for all furs with this pelt.
	 *
	 * @param most states in the textures at a time; the loader's option by default
	 * @returns rejects with an Error of one sentence on failure; the fur stays as it was, and a later call tries again
	 */
	loadStates(most?: number): Promise<void> {
		return this.pelt.load(most);
	}

	/** Wetness and dirt over the body; undefined: dry and clean. Furs of one body may share it. */
	get weather(): FurWeather | undefined {
		return this.#staining.weather;
	}

	set weather(weather: FurWeather | undefined) {
		if (!this.#staining.attach(weather)) return;
		if (weather) this.#mark();
		this.#staining.show();
	}

	/**
	 * Frees materials, and what is shared with copies of the body and other furs of the pelt once nobody else uses it; for a
	 * fur made by `dressFur` the materials alone, the rest is the body's and the pelt's.
	 */
	readonly dispose = (): void => {
		this.motion = undefined;
		this.weather = undefined;
		this.swing = undefined;
		this.#staining.dispose();
		this.#parts.removeFromParent();
		this.#parts.owner = undefined;
		furs.delete(this.#parts);
		this.ground.skin.bare(this.asset);
		this.#sharers.leave(this);
		for (const part of [this.fins, this.shells]) {
			part?.dispose();
			part?.material.dispose();
		}
		this.material.dispose();
	};
}
