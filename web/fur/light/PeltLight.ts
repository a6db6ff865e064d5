import type { IUniform, Texture } from 'three';
import { curveTable, SlabLight, type SlabState, standInState } from './SlabLight.ts';
import { TrimLight } from './TrimLight.ts';
import { momentUniforms, type SlabMeanCurves, type TexelCoding } from './texels.ts';

/** Light of the slabs in one material: mean curves of the states shown, and corrections for cut hairs. */
export class PeltLight {
	/** Uniforms of the shaders, by name. */
	readonly uniforms: Record<string, IUniform>;
	/** Mean curves with the dry pelt's weights; format 2.x only. */
	readonly means: SlabMeanCurves | undefined;
	readonly #texels: TexelCoding;
	readonly #planes: readonly Texture[];
	readonly #layers: number;
	readonly #fin: boolean;
	/** Owner of the shared table of curves, if not this. */
	readonly #leader: PeltLight | undefined;
	readonly #slabLight: SlabLight | undefined;
	#trimLight: TrimLight | undefined;
	/** Slabs of the states in the textures. */
	#states: readonly SlabState[];
	/** Stand-ins for the slabs of cut fur. */
	#places: ArrayLike<number> | undefined;

	/** @param planes of the coefficients @param layers slabs of the pelt @param fin whether the frame is a fin's */
	constructor(texels: TexelCoding, planes: readonly Texture[], layers: number, fin: boolean, leader?: PeltLight) {
		const { means, basis } = texels;
		this.means = means;
		this.#texels = texels;
		this.#planes = planes;
		this.#layers = layers;
		this.#fin = fin;
		this.#leader = leader;
		this.#states = means ? [means] : [];
		this.#slabLight = means && new SlabLight(basis, means, this.#states, fin);
		this.uniforms = {
			...(means
				? {
						curveTable: leader?.uniforms.curveTable ?? { value: curveTable(means.curves) },
						slabLight: { value: this.#slabLight?.texture },
					}
				: momentUniforms(texels, fin)),
			trimLight: { value: null },
		};
	}

	/** Places in whole fur with the light that the slabs of cut fur get; see `standIns`. */
	places(share: number): Float64Array {
		return this.#trim().places(share);
	}

	/** Light slabs as at these places; undefined: at their own. */
	cut(places: Float64Array | undefined): void {
		if (places) this.#trim().set(places);
		this.#places = places;
		this.#weigh();
	}

	/** Show the states in the textures, the driest first; states without weights use the dry pelt's. */
	show(states: readonly Partial<SlabState>[] = [this.means ?? {}]): void {
		const { means } = this;
		if (!means) return;
		this.#states = states.map(({ weights = means.weights, multiple }) => ({ weights, multiple }));
		this.#weigh();
	}

	/** Give every slab the mean light of its stand-in. */
	#weigh(): void {
		const { slabLight } = this.uniforms;
		const places = this.#places;
		if (!this.#slabLight || !slabLight) return;
		this.#slabLight.states = places ? this.#states.map((state) => standInState(state, places)) : this.#states;
		slabLight.value = this.#slabLight.texture;
	}

	/** Trim table, computed from the material's first texels and used for all states. */
	#trim(): TrimLight {
		if (!this.#trimLight) {
			this.#trimLight = new TrimLight(this.#planes, this.#texels, this.#layers, this.#fin ? 1 : this.#layers);
			(this.uniforms.trimLight as IUniform).value = this.#trimLight.texture;
		}
		return this.#trimLight;
	}

	/** Frees its textures. */
	dispose(): void {
		this.#trimLight?.texture.dispose();
		this.#slabLight?.texture.dispose();
		if (!this.#leader) (this.uniforms.curveTable as IUniform<Texture> | undefined)?.value.dispose();
	}
}
