import { BufferGeometry, type Color, Object3D, Scene, type Texture } from 'three';
import type { Columns } from './clip.ts';
import { FinMaterial } from './FinMaterial.ts';
import { FurMaterial } from './FurMaterial.ts';
import type { FurWeather } from './FurWeather.ts';
import { FurFins } from './fins.ts';
import { Follicles } from './follicles.ts';
import type { FurAsset, Pelt } from './format.ts';
import type { PeltStates } from './PeltStates.ts';
import { FurShells } from './shells.ts';
import type { Skin, Wetness } from './skin.ts';
import type { FurTextures } from './texels.ts';

/** What a body brings to a fur: what it stands on, and what is seen between its hairs. */
export interface Ground {
	skin: Skin;
	/** Base colour of the model, which multiplies the fur's. */
	colour: Color;
	/** What the shells stand on, the node that it belongs to, and what the fins stand on. */
	surface: BufferGeometry;
	placement: Object3D;
	quads: BufferGeometry | undefined;
	/** Node of the quads, where its axes may be others than the shells'. */
	quadPlacement: Object3D | undefined;
	/** What the fins' second texture coordinate is multiplied by to be 1 at their tips. */
	finHeights: number;
}

/** Which weather a fur can show. */
export interface HasStates {
	/** Whether it can be wet. */
	wet: boolean;
	/** Whether it can be dirty. */
	dirt: boolean;
}

/** Shells, fins and the shade of the skin below them: `gltf.userData.fur` of a loaded asset, or made by `dress`. */
export class Fur {
	/** What its file says of it. */
	readonly asset: FurAsset;
	/** What the shells are drawn with, and what else the asset holds of them. */
	readonly textures: FurTextures;
	/** What the fins are drawn with, where it has some. */
	readonly finTextures: FurTextures | undefined;
	/** The shells' own, whatever method they wear. */
	readonly material: FurMaterial;
	/** Drawn in the scene beside the skin. */
	readonly shells: FurShells;
	/** What makes the outline, drawn before the shells; the shells show without it, too: `fins.visible = false`. */
	readonly fins: FurFins | undefined;
	/** The body: a mesh, or a group of one for each material. */
	readonly skin: Object3D;
	/** What it stands on, for `dress`. */
	readonly ground: Ground;
	/** Its textures and what they hold, for `dress`. */
	readonly pelt: PeltStates;
	readonly #parts = new Object3D();
	readonly #release: () => void;
	#length = 1;
	#clip: Columns | undefined;
	#weather: FurWeather | undefined;

	/** @param release frees what this fur alone has beside its materials, its geometry included */
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
				? new FurFins(quads, new FinMaterial(fin, finTextures, this.material, { finHeights }))
				: undefined;
		this.shells = new FurShells(surface, placement, asset, this.material);
		this.fins?.join(this.shells, quadPlacement ?? this.shells);
		this.#parts.name = 'fur of a body';
		for (const part of [this.fins, this.shells]) if (part) this.#parts.add(part);
		this.skin.parent?.add(this.#parts);
		skin.cover(asset);
		pelt.join(this.#stain);
	}

	/** Whether it is seen, and the skin as dark as below it: of several furs of a body below the one that was shown last. */
	get visible(): boolean {
		return this.#parts.visible;
	}

	set visible(on: boolean) {
		this.#parts.visible = on;
		if (on) this.ground.skin.cover(this.asset, this.#wetness());
		else this.ground.skin.bare(this.asset);
	}

	/** How long it is, share of what was baked, 0.1 to 2: below 1 it is cut, above it is drawn out. */
	get length(): number {
		return this.#length;
	}

	set length(share: number) {
		this.#length = share;
		this.material.trim = Math.min(share, 1);
		this.shells.furLength = share * this.asset.length;
		this.fins?.fit(this.shells);
	}

	/**
	 * What its hairs stand in, and are moved, wetted and soiled by: the same ones for all furs of a body. Shells and fins
	 * are told theirs when they are first asked for.
	 */
	get follicles(): Follicles {
		return this.#mark();
	}

	/**
	 * How far hairs are from where they were combed: RGBA floats, a texel for each of `follicles`, XYZ = displacement of the
	 * tip beyond the comb, in the tangent plane, share of the length, axes of the shells' mesh; with the comb no longer than
	 * 0.8. What writes into the texture on the GPU adds 1 to its `version`. Undefined, as the fur was baked, costs nothing; it
	 * is that again when the texture is disposed of.
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
	 * Columns of the picture within which shells and fins are drawn, undefined: all. So two furs of a body, in other light
	 * each, share one render of the scene.
	 */
	get clip(): Columns | undefined {
		return this.#clip;
	}

	set clip(columns: Columns | undefined) {
		this.#clip = columns;
		for (const part of [this.fins, this.shells]) if (part) part.clip = columns;
	}

	#mark(): Follicles {
		const follicles = Follicles.of(this.shells.geometry);
		for (const part of [this.fins, this.shells]) if (part) follicles.mark(part.geometry);
		return follicles;
	}

	/** What of its file there is beside dry, clean fur; shown once `loadStates` has it. */
	get hasStates(): HasStates {
		const { wet, dirty } = this.pelt.all;
		return { wet: wet.length > 1, dirt: dirty !== undefined };
	}

	/**
	 * Fetches and decodes the pelt's wet and dirty states, bit by bit, once: for all furs that wear it.
	 *
	 * @param most states in the textures at a time, by default as the loader was told
	 * @returns rejects with an Error of one sentence where that fails; the fur is then as before, and it can be tried again
	 */
	loadStates(most?: number): Promise<void> {
		return this.pelt.load(most);
	}

	/** Where it is wet and dirty, undefined: nowhere. Furs of one body may have theirs in common. */
	get weather(): FurWeather | undefined {
		return this.#weather;
	}

	set weather(weather: FurWeather | undefined) {
		if (weather === this.#weather) return;
		this.#weather?.leave(this.#stain);
		this.#weather = weather;
		weather?.join(this.#stain);
		if (weather) this.#mark();
		this.#stain();
	}

	/** Shows the weather, as far as there are states for it. */
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
		if (weather || this.#isInScene()) this.pelt.want(this.#stain, driest, wettest);
		else this.pelt.want(this.#stain, 1, 0);
	};

	/** A pelt that others are dressed in need not be: without weather of its own nobody asks how wet it is then. */
	#isInScene(): boolean {
		let top: Object3D = this.#parts;
		while (top.parent) top = top.parent;
		return top instanceof Scene;
	}

	/** Undefined where it is not seen. */
	#wetness(): Wetness | undefined {
		const weather = this.#weather;
		return 'WET' in this.material.defines && weather
			? { follicles: this.follicles, at: (follicle) => weather.wetnessAt(follicle) }
			: undefined;
	}

	/** Frees geometry, materials and textures; of a dressed body the materials alone, the rest is the body's and the pelt's. */
	readonly dispose = (): void => {
		this.weather = undefined;
		this.swing = undefined;
		this.pelt.leave(this.#stain);
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

/** Another geometry of the same vertices. */
function shareGeometry(source: BufferGeometry): BufferGeometry {
	const into = new BufferGeometry();
	into.setIndex(source.index);
	for (const [name, attribute] of Object.entries(source.attributes)) into.setAttribute(name, attribute);
	into.userData = source.userData;
	return into;
}

/** To be called before such a geometry is disposed of: it would take the vertices off the GPU with it. */
function unshareGeometry(geometry: BufferGeometry): void {
	geometry.setIndex(null);
	for (const name of Object.keys(geometry.attributes)) geometry.deleteAttribute(name);
}

/** What `dress` may be told. */
export interface DressOptions {
	/** How far the body's second tip colour shows (on its belly, in patches), 0..1: 0 for a pelt that is the same all over. */
	tips?: number;
}

/**
 * A body in the fur of another asset: its meshes in the other's planes, basis, colours, light curves, as long on this body
 * and in tiles of such a size as the other has them on its own, each measured by its largest side.
 *
 *     const fox = dress(bunny, pelt); // both loaded: `gltf.userData.fur`
 *     bunny.visible = false;
 *
 * It stands beside the body's own fur, looks as that does at the moment (gloss and the like), and is seen. It has the body's
 * geometry and the pelt's textures, and leaves them alone when it is disposed of: body and pelt have to outlive it, the
 * pelt's model needs no scene. How fur is combed and how its length changes from place to place is the body's. Texture
 * coordinates that the body was baked with (`--uv own`) may show a seam where they close; lapped ones don't.
 */
export function dress(body: Fur, pelt: Fur, { tips = 1 }: DressOptions = {}): Fur {
	const { ground } = body;
	const length = (pelt.asset.length * ground.skin.extent) / pelt.ground.skin.extent;
	const tile = length / pelt.asset.height;
	const { skin, shells, fins } = body.asset;
	const { fins: _, ...own } = pelt.asset;
	const tiles = ((body.asset.tiles ?? 1) * (body.asset.length / body.asset.height)) / tile;
	const asset: FurAsset = { ...own, skin, shells, tiles, length, ...(fins !== undefined && { fins }) };
	const quads = body.fins && shareGeometry(body.fins.geometry);
	const dressed = new Fur(
		asset,
		pelt.pelt,
		{ ...ground, surface: body.shells.geometry, quads, quadPlacement: undefined },
		() => {
			unshareGeometry(dressed.shells.geometry);
			if (quads) unshareGeometry(quads);
		},
	);
	dressed.swing = body.swing;
	dressed.weather = body.weather;
	const { gloss, sharpness, backlight, environment, lampsPerFragment, multisampled } = body.material;
	const look = { gloss, sharpness, backlight, environment, lampsPerFragment, multisampled };
	Object.assign(dressed.material, look, { tipShare: tips });
	return dressed;
}
