import { type BufferGeometry, type Color, Object3D, Scene, type Texture } from 'three';
import type { FurMethod } from './baselines/furMethod.ts';
import { FurFollicles } from './body/FurFollicles.ts';
import type { Skin, Wetness } from './body/Skin.ts';
import type { FurAsset, Pelt } from './format.ts';
import type { FurTextures } from './light/texels.ts';
import type { FurMotion } from './motion/FurMotion.ts';
import type { PeltStates } from './planes/PeltStates.ts';
import type { FurColumns } from './shells/clip.ts';
import { FurFinMaterial } from './shells/FurFinMaterial.ts';
import { FurFins } from './shells/FurFins.ts';
import { FurMaterial } from './shells/FurMaterial.ts';
import { FurShells } from './shells/FurShells.ts';
import { updateFurs } from './updateFurs.ts';
import type { FurWeather } from './weather/FurWeather.ts';

/** Surfaces of a body that fur is drawn on. */
export interface Ground {
	skin: Skin;
	/** Base colour of the model, which multiplies the fur's. */
	colour: Color;
	/** Geometry below the shells, the shells' node, and the quads of the fins. */
	surface: BufferGeometry;
	placement: Object3D;
	quads: BufferGeometry | undefined;
	/** Node of the quads; its axes may differ from the shells'. */
	quadPlacement: Object3D | undefined;
	/** Factor of the fins' second texture coordinate that makes it 1 at the tips. */
	finHeights: number;
}

/** Weather that a fur can show. */
export interface FurStates {
	/** Whether it can be wet. */
	wet: boolean;
	/** Whether it can be dirty. */
	dirt: boolean;
}

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
	readonly #parts = new Object3D();
	readonly #release: () => void;
	#clip: FurColumns | undefined;
	#motion: FurMotion | undefined;
	#weather: FurWeather | undefined;
	/** Argument of `updateFurs`, made once. */
	readonly #itself = [this];

	/** @param release frees what belongs to this fur alone beside its materials, geometry included */
	constructor(asset: FurAsset, pelt: PeltStates, ground: Ground, release: () => void) {
		const [{ textures }, fins] = pelt.cuts;
		const finTextures = fins?.textures;
		const { skin, surface, placement, quads, quadPlacement, colour, finHeights } = ground;
		const { fin } = asset.pelts[0] as Pelt;
		this.asset = asset;
		this.pelt = pelt;
		this.textures = textures;
		this.finTextures = finTextures;
		this.ground = ground;
		this.skin = skin.object;
		this.#release = release;
		this.material = new FurMaterial(asset, textures, { skinColour: colour.clone() });
		this.fins =
			fin && quads && finTextures
				? new FurFins(quads, new FurFinMaterial(fin, finTextures, this.material, { finHeights }))
				: undefined;
		this.shells = new FurShells(surface, placement, asset, this.material);
		this.fins?.join(this.shells, quadPlacement ?? this.shells);
		this.#parts.name = 'fur of a body';
		for (const part of [this.fins, this.shells]) if (part) this.#parts.add(part);
		this.skin.parent?.add(this.#parts);
		skin.cover(asset);
		pelt.subscribe(this.#stain);
	}

	/** Whether shells and fins are drawn and the skin is shaded. Of several furs of a body, the one shown last shades the skin. */
	get visible(): boolean {
		return this.#parts.visible;
	}

	set visible(on: boolean) {
		this.#parts.visible = on;
		if (on) this.ground.skin.cover(this.asset, this.#wetness());
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

	/**
	 * Length of the longest hairs, model units; 0.1 to 2 times `asset.length`, the baked one. Shorter hairs are cut, longer
	 * ones are stretched.
	 */
	get length(): number {
		return this.shells.furLength;
	}

	set length(length: number) {
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
		return this.#motion;
	}

	set motion(motion: FurMotion | undefined) {
		if (motion === this.#motion) return;
		this.#motion?.leave(this.#bending);
		this.#motion = motion;
		motion?.join(this.#bending);
		this.swing = motion?.swing;
	}

	readonly #bending = {
		follow: () => {
			this.swing = this.#motion?.swing;
		},
		detach: () => {
			this.motion = undefined;
		},
	};

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
		const before = this.material.swing;
		if (texture === before) return;
		if (texture) this.#mark();
		before?.removeEventListener('dispose', this.#straighten);
		texture?.addEventListener('dispose', this.#straighten);
		this.material.swing = texture;
	}

	readonly #straighten = (): void => {
		this.swing = undefined;
	};

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
		return this.#weather;
	}

	set weather(weather: FurWeather | undefined) {
		if (weather === this.#weather) return;
		this.#weather?.leave(this.#staining);
		this.#weather = weather;
		weather?.join(this.#staining);
		if (weather) this.#mark();
		this.#stain();
	}

	readonly #staining = {
		follow: () => this.#stain(),
		detach: () => {
			this.weather = undefined;
		},
	};

	/** Show the weather as far as there are states for it. */
	readonly #stain = (): void => {
		const weather = this.#weather;
		const { stains, driest = 0, wettest = 0, dirtiest = 0 } = weather ?? {};
		const { wet, dirty, loaded, all } = this.pelt;
		const mud = dirtiest > 0 && loaded && all.dirty ? this.asset.mud : undefined;
		this.material.setTextures(this.textures);
		if (this.finTextures) this.fins?.material.setTextures(this.finTextures);
		const shown = stains && (mud || (wettest > 0 && wet.length > 1));
		const states = wettest > 0 ? wet : wet.slice(0, 1);
		this.material.setStains(shown ? { stains, wet: states, mud, clumps: dirty ? wet.length : undefined } : undefined);
		this.ground.skin.soak(this.asset, this.#wetness());
		if (weather || this.#isInScene()) this.pelt.request(this.#stain, driest, wettest);
		else this.pelt.request(this.#stain, 1, 0);
	};

	/** Whether the fur stands in a scene. A pelt that only dresses other bodies need not, and then asks for no states. */
	#isInScene(): boolean {
		let top: Object3D = this.#parts;
		while (top.parent) top = top.parent;
		return top instanceof Scene;
	}

	/** Wetness of the skin; undefined unless wet states are shown. */
	#wetness(): Wetness | undefined {
		const weather = this.#weather;
		return 'WET' in this.material.defines && weather
			? { follicles: this.follicles, at: (follicle) => weather.wetnessAt(follicle) }
			: undefined;
	}

	/** Frees geometry, materials and textures; for a fur made by `dressFur` the materials alone, the rest is the body's and the pelt's. */
	readonly dispose = (): void => {
		this.motion = undefined;
		this.weather = undefined;
		this.swing = undefined;
		this.pelt.unsubscribe(this.#stain);
		this.#parts.removeFromParent();
		this.ground.skin.bare(this.asset);
		this.#release();
		for (const part of [this.fins, this.shells]) {
			part?.dispose();
			part?.material.dispose();
		}
		this.material.dispose();
	};
}
