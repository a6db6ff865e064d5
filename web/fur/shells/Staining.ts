import { type Object3D, Scene } from 'three';
import type { FurFollicles } from '../body/FurFollicles.ts';
import type { Skin, Wetness } from '../body/skin/Skin.ts';
import type { FurAsset } from '../format.ts';
import type { FurTextures } from '../light/texels.ts';
import type { PeltStates } from '../planes/PeltStates.ts';
import type { FurWeather } from '../weather/FurWeather.ts';
import type { FurFins } from './FurFins.ts';
import type { FurMaterial } from './FurMaterial.ts';

/** Weather that a fur can show. */
export interface FurStates {
	/** Whether it can be wet. */
	wet: boolean;
	/** Whether it can be dirty. */
	dirt: boolean;
}

/** Fur that shows weather: a `Fur`. */
interface StainedFur {
	readonly asset: FurAsset;
	readonly pelt: PeltStates;
	readonly ground: { readonly skin: Skin };
	readonly material: FurMaterial;
	readonly shells: Object3D;
	readonly textures: FurTextures;
	readonly fins: FurFins | undefined;
	readonly finTextures: FurTextures | undefined;
	readonly follicles: FurFollicles;
	weather: FurWeather | undefined;
}

/** Weather as one fur shows it: states of the pelt in its textures, and wet skin below. */
export class Staining {
	readonly #fur: StainedFur;
	#weather: FurWeather | undefined;
	readonly #follower = {
		follow: () => this.show(),
		detach: () => {
			this.#fur.weather = undefined;
		},
	};

	constructor(fur: StainedFur) {
		this.#fur = fur;
		fur.pelt.subscribe(this.show);
	}

	/** Attached weather, if any. */
	get weather(): FurWeather | undefined {
		return this.#weather;
	}

	/** @returns whether it is another one */
	attach(weather: FurWeather | undefined): boolean {
		if (weather === this.#weather) return false;
		this.#weather?.leave(this.#follower);
		this.#weather = weather;
		weather?.join(this.#follower);
		return true;
	}

	/** Show the weather as far as there are states for it. */
	readonly show = (): void => {
		const { asset, pelt, material, fins, textures, finTextures, ground } = this.#fur;
		const weather = this.#weather;
		const { stains, driest = 0, wettest = 0, dirtiest = 0 } = weather ?? {};
		const { wet, dirty, loaded, all } = pelt;
		const mud = dirtiest > 0 && loaded && all.dirty ? asset.mud : undefined;
		material.setTextures(textures);
		if (finTextures) fins?.material.setTextures(finTextures);
		const shown = stains && (mud || (wettest > 0 && wet.length > 1));
		const states = wettest > 0 ? wet : wet.slice(0, 1);
		material.setStains(shown ? { stains, wet: states, mud, clumps: dirty ? wet.length : undefined } : undefined);
		ground.skin.soak(asset, this.wetness());
		if (weather || this.#isInScene()) pelt.request(this.show, driest, wettest);
		else pelt.request(this.show, 1, 0);
	};

	/** Whether the fur stands in a scene. A pelt that only dresses other bodies need not, and then asks for no states. */
	#isInScene(): boolean {
		let top: Object3D = this.#fur.shells;
		while (top.parent) top = top.parent;
		return top instanceof Scene;
	}

	/** Wetness of the skin; undefined unless wet states are shown. */
	wetness(): Wetness | undefined {
		const weather = this.#weather;
		return 'WET' in this.#fur.material.defines && weather
			? { follicles: this.#fur.follicles, at: (follicle) => weather.wetnessAt(follicle) }
			: undefined;
	}

	/** No longer follows the pelt. */
	dispose(): void {
		this.#fur.pelt.unsubscribe(this.show);
	}
}
