/** The states of a pelt: fetched when they are first wanted, and stacked in the textures that its furs are drawn with. */

import type { CompressedArrayTexture } from 'three';
import type { FurAsset, Pelt } from './format.ts';
import { decodeAll, decodePlanes, type Layout, type Plane, type PlaneFile, type Role, stacked } from './levels.ts';
import { textureArray } from './planes.ts';
import { pairFor, type States, statesOf } from './states.ts';
import type { FurTextures } from './texels.ts';

/** What is stacked; directions are the dry state's whatever the weather. */
const ROLES = ['plane0', 'plane1', 'colour'] as const satisfies Role[];

/** A pelt seen from above or, for fins, from the side. */
export interface Cut {
	/** A slab per layer; where there are more states, state after state. Replaced in this very object. */
	textures: FurTextures;
	/** Of the dry state. */
	layout: Layout;
	/** The files of another state, coefficients first. */
	fetch(state: Pelt): Promise<PlaneFile[]>;
}

/** Somebody who wears the pelt: told when the textures are others. */
export type Wearer = () => void;

/** What a wearer wants who is not seen. */
const NONE = [1, 0] as const;

/** The states of one pelt, for all furs that wear it. */
export class PeltStates {
	/** All that there are. */
	readonly all: States;
	/** As from the pelt's own asset. */
	readonly cuts: readonly [shells: Cut, fins?: Cut];
	readonly #layers: number;
	readonly #most: number;
	/** Which states the textures hold, in their order; a dirty one is the last. */
	#resident: readonly Pelt[];
	#wet: readonly Pelt[];
	/** The files of the others, where the textures hold two at most. */
	#files: Map<Pelt, PlaneFile[][]> | undefined;
	/** Where the textures may hold others in its place. */
	#dry: Plane[][];
	readonly #wearers = new Map<Wearer, readonly [from: number, to: number]>();
	#loading: Promise<void> | undefined;
	#settling = Promise.resolve();
	#changing = false;
	#gone = false;

	/**
	 * @param cuts with the textures of the first pelt
	 * @param most states in the textures at a time; fewer than there are: two
	 * @param layers most layers that a texture may have
	 */
	constructor(asset: FurAsset, cuts: readonly [shells: Cut, fins?: Cut], most: number, layers: number) {
		this.all = statesOf(asset);
		this.cuts = cuts;
		this.#most = most;
		this.#layers = layers;
		this.#resident = this.#wet = [this.all.wet[0]];
		this.#dry = this.#all(({ textures }) =>
			ROLES.flatMap((role) => {
				const texture = textures[role] as CompressedArrayTexture | undefined;
				return texture ? { role, name: texture.name, levels: texture.mipmaps.map(({ data }) => data as never) } : [];
			}),
		);
	}

	/** States of rising wetness that the textures hold, the first layers the driest one's. */
	get wet(): readonly Pelt[] {
		return this.#wet;
	}

	/** Whether the textures hold the dirty state, after the wet ones. */
	get dirty(): boolean {
		return this.#resident.some(({ dirt }) => dirt);
	}

	/** Whether the states have been loaded, in the textures or not. */
	get loaded(): boolean {
		return this.#files !== undefined || this.#resident.length > 1;
	}

	/** Fetches all states, once, and stacks them. @param most as of the constructor */
	load(most = this.#most): Promise<void> {
		this.#loading ??= this.#load(most).catch((error) => {
			this.#loading = undefined;
			throw error;
		});
		return this.#loading;
	}

	async #load(most: number): Promise<void> {
		const { wet, dirty } = this.all;
		const states = dirty ? [...wet, dirty] : [...wet];
		if (states.length === 1) return;
		const others = states.slice(1);
		const fetched = await Promise.all(others.map((state) => Promise.all(this.#all((cut) => cut.fetch(state)))));
		const files = new Map(others.map((state, i) => [state, fetched[i] as PlaneFile[][]]));
		const { layers } = this.cuts[0].layout.extent;
		const two = most < states.length || layers * states.length > this.#layers;
		if (two) {
			// What cannot be read is refused now, not when it is to be shown.
			for (const own of files.values())
				for (const [c, { layout }] of this.#all((cut) => cut).entries())
					await decodeAll(own[c] as PlaneFile[], layout.extent);
			if (this.#gone) return;
			this.#files = files;
			return this.#settle();
		}
		const planes = new Map<Pelt, Plane[][]>();
		for (const state of others) planes.set(state, await this.#decode(state, files));
		if (this.#gone) return;
		this.#show(states, planes);
		this.#dry = [];
	}

	/** Has somebody told of other textures, who wants no state as yet. */
	join(wearer: Wearer): void {
		this.#wearers.set(wearer, NONE);
	}

	/** Tells them nothing any more. */
	leave(wearer: Wearer): void {
		this.#wearers.delete(wearer);
		if (this.#files) void this.#settle();
	}

	/**
	 * How wet they are, from their driest place to their wettest: where there is room for two states it is the two around that.
	 * From 1 to 0: they are not seen, and want none.
	 */
	want(wearer: Wearer, from: number, to: number): void {
		this.#wearers.set(wearer, [from, to]);
		if (this.#files) void this.#settle();
	}

	/** The states that all wearers together want, where there is room for two. */
	#wanted(): Pelt[] {
		const { wet } = this.all;
		const ranges = [...this.#wearers.values()];
		const from = Math.min(1, ...ranges.map(([driest]) => driest));
		const to = Math.max(0, ...ranges.map(([, wettest]) => wettest));
		const wetnesses = wet.map(({ wetness = 0 }) => wetness);
		return pairFor(wetnesses, from, to).map((i) => wet[i] as Pelt);
	}

	/** Shows what is wanted, one change after the other; at once where nothing has to be decoded for it. */
	#settle(): Promise<void> {
		if (!this.#changing) {
			this.#changing = true;
			this.#settling = this.#change();
		}
		return this.#settling;
	}

	async #change(): Promise<void> {
		try {
			for (let wanted = this.#wanted(); !this.#gone && !this.#holds(wanted); wanted = this.#wanted()) {
				const planes = new Map<Pelt, Plane[][]>();
				for (const state of wanted) {
					const at = this.#resident.indexOf(state);
					if (at > 0) planes.set(state, this.#shown(at));
					else if (state !== this.all.wet[0] && this.#files) planes.set(state, await this.#decode(state, this.#files));
				}
				if (!this.#gone) this.#show(wanted, planes);
			}
		} finally {
			this.#changing = false;
		}
	}

	#holds(states: readonly Pelt[]): boolean {
		return states.length === this.#resident.length && states.every((state, i) => state === this.#resident[i]);
	}

	async #decode(state: Pelt, files: Map<Pelt, PlaneFile[][]>): Promise<Plane[][]> {
		const own = files.get(state) as PlaneFile[][];
		const planes: Plane[][] = [];
		for (const [c, { layout }] of this.#all((cut) => cut).entries()) {
			const view = { ...layout.view, rise: layout.view.rise * (state.length ?? 1) };
			planes.push(await decodePlanes(own[c] as PlaneFile[], { ...layout, view }));
		}
		return planes;
	}

	/** The planes of a state that is in the textures. */
	#shown(at: number): Plane[][] {
		return this.#all(({ textures }) =>
			ROLES.flatMap((role) => {
				const texture = textures[role] as CompressedArrayTexture | undefined;
				if (!texture) return [];
				const levels = texture.mipmaps.map(({ data }) => {
					const size = data.length / this.#resident.length;
					return (data as Uint8Array<ArrayBuffer>).slice(at * size, (at + 1) * size);
				});
				return { role, name: texture.name, levels };
			}),
		);
	}

	#show(states: readonly Pelt[], planes: ReadonlyMap<Pelt, Plane[][]>): void {
		for (const [c, { textures, layout }] of this.#all((cut) => cut).entries()) {
			for (const role of ROLES) {
				const old = textures[role];
				if (!old) continue;
				const levels = states.flatMap((state) => {
					const own = (planes.get(state) ?? this.#dry)[c]?.find((plane) => plane.role === role);
					return own ? [own.levels] : [];
				});
				const extent = { ...layout.extent, layers: layout.extent.layers * levels.length };
				const texture = textureArray(old.name, stacked(levels), extent, role === 'colour');
				texture.anisotropy = old.anisotropy;
				texture.wrapT = old.wrapT;
				textures[role] = texture;
				old.dispose();
			}
		}
		this.#resident = states;
		this.#wet = states.filter(({ dirt }) => !dirt);
		for (const wearer of this.#wearers.keys()) wearer();
	}

	#all<T>(of: (cut: Cut) => T): T[] {
		return this.cuts.flatMap((cut) => (cut ? [of(cut)] : []));
	}

	/** Frees the textures. */
	dispose(): void {
		this.#gone = true;
		this.#files = undefined;
		for (const { textures } of this.#all((cut) => cut))
			for (const texture of Object.values({ ...textures })) texture?.dispose();
	}
}
