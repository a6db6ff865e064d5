/** WeatherStates of a pelt: fetched on first request and stacked in the textures of its furs. */

import type { CompressedArrayTexture } from 'three';
import type { FurAsset, Pelt } from '../format.ts';
import type { FurTextures } from '../light/texels.ts';
import {
	decodeAll,
	decodePlanes,
	depthOf,
	type Layout,
	type Plane,
	type PlaneFile,
	type Role,
	stacked,
} from './mipLevels.ts';
import { textureArray } from './planes.ts';
import { pairFor, statesOf, type WeatherStates } from './states.ts';

/** Planes that are stacked; directions are always the dry state's. */
const ROLES = ['plane0', 'plane1', 'colour'] as const satisfies Role[];

/** Planes of a pelt from above or, for fins, from the side. */
export interface Cut {
	/** A slab per layer, state after state. Replaced within this object. */
	textures: FurTextures;
	/** Layout of the dry state. */
	layout: Layout;
	/** Fetches the files of another state, coefficients first. */
	fetch(state: Pelt): Promise<PlaneFile[]>;
}

/** Called when textures are replaced. */
export type StatesListener = () => void;

/** Request of a hidden fur: no state. */
const NO_STATE = [1, 0] as const;

/** WeatherStates of one pelt, for all its furs. */
export class PeltStates {
	/** All states of the asset. */
	readonly all: WeatherStates;
	/** Cuts of the pelt's own asset. */
	readonly cuts: readonly [shells: Cut, fins?: Cut];
	readonly #layers: number;
	readonly #most: number;
	/** WeatherStates in the textures, in their order; a dirty one is the last. */
	#resident: readonly Pelt[];
	#wet: readonly Pelt[];
	/** Files of the other states, where the textures hold two at most. */
	#files: Map<Pelt, PlaneFile[][]> | undefined;
	/** Planes of the dry state, kept where others may take their place. */
	#dry: Plane[][];
	readonly #listeners = new Map<StatesListener, readonly [from: number, to: number]>();
	#loading: Promise<void> | undefined;
	#updating = Promise.resolve();
	#changing = false;
	#gone = false;

	/**
	 * @param cuts cuts with the textures of the first state
	 * @param most states in the textures at a time; any number below that of all states counts as two
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

	/** WeatherStates in the textures by rising wetness; the first layers are the driest one's. */
	get wet(): readonly Pelt[] {
		return this.#wet;
	}

	/** Whether the dirty state is in the textures, after the wet ones. */
	get dirty(): boolean {
		return this.#resident.some(({ dirt }) => dirt);
	}

	/** Whether the states have been loaded, in the textures or not. */
	get loaded(): boolean {
		return this.#files !== undefined || this.#resident.length > 1;
	}

	/** Fetches all states, once, and stacks them. @param most as in the constructor */
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
		const layers = depthOf(this.cuts[0].layout);
		const two = most < states.length || layers * states.length > this.#layers;
		if (two) {
			// Refuse unreadable files now, not when they are to be shown.
			for (const own of files.values())
				for (const [c, { layout }] of this.#all((cut) => cut).entries())
					await decodeAll(own[c] as PlaneFile[], layout.extent);
			if (this.#gone) return;
			this.#files = files;
			return this.#update();
		}
		const planes = new Map<Pelt, Plane[][]>();
		for (const state of others) planes.set(state, await this.#decode(state, files));
		if (this.#gone) return;
		this.#show(states, planes);
		this.#dry = [];
	}

	/** Subscribe to changes of the textures, requesting no state as yet. */
	subscribe(listener: StatesListener): void {
		this.#listeners.set(listener, NO_STATE);
	}

	/** Unsubscribe. */
	unsubscribe(listener: StatesListener): void {
		this.#listeners.delete(listener);
		if (this.#files) void this.#update();
	}

	/**
	 * Request the states for fur between these wetnesses. With room for two states, the two around the range of all requests
	 * are shown. From 1 to 0 requests none.
	 */
	request(listener: StatesListener, from: number, to: number): void {
		this.#listeners.set(listener, [from, to]);
		if (this.#files) void this.#update();
	}

	/** WeatherStates for all requests together, where there is room for two. */
	#requested(): Pelt[] {
		const { wet } = this.all;
		const ranges = [...this.#listeners.values()];
		const from = Math.min(1, ...ranges.map(([driest]) => driest));
		const to = Math.max(0, ...ranges.map(([, wettest]) => wettest));
		const wetnesses = wet.map(({ wetness = 0 }) => wetness);
		return pairFor(wetnesses, from, to).map((i) => wet[i] as Pelt);
	}

	/** Show the requested states, one change after the other; at once where nothing has to be decoded. */
	#update(): Promise<void> {
		if (!this.#changing) {
			this.#changing = true;
			this.#updating = this.#change();
		}
		return this.#updating;
	}

	async #change(): Promise<void> {
		try {
			for (let requested = this.#requested(); !this.#gone && !this.#holds(requested); requested = this.#requested()) {
				const planes = new Map<Pelt, Plane[][]>();
				for (const state of requested) {
					const at = this.#resident.indexOf(state);
					if (at > 0) planes.set(state, this.#shown(at));
					else if (state !== this.all.wet[0] && this.#files) planes.set(state, await this.#decode(state, this.#files));
				}
				if (!this.#gone) this.#show(requested, planes);
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
			const rise = layout.rise * (state.length ?? 1);
			planes.push(await decodePlanes(own[c] as PlaneFile[], { ...layout, rise }));
		}
		return planes;
	}

	/** Planes of a state in the textures. */
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
				const extent = { ...layout.extent, layers: depthOf(layout) * levels.length };
				const texture = textureArray(old.name, stacked(levels), extent, role === 'colour');
				texture.anisotropy = old.anisotropy;
				texture.wrapT = old.wrapT;
				texture.minFilter = old.minFilter;
				textures[role] = texture;
				old.dispose();
			}
		}
		this.#resident = states;
		this.#wet = states.filter(({ dirt }) => !dirt);
		for (const listener of this.#listeners.keys()) listener();
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
