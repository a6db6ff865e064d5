import type { IUniform, Texture } from 'three';
import { curveTable, SlabLight, type SlabState, standInState } from './SlabLight.ts';
import { TrimLight } from './TrimLight.ts';
import { momentUniforms, type SlabMeanCurves, type Texels } from './texels.ts';

/** What slabs are lit by in one material: the mean curves of the states that it shows, and what changes when hairs are cut. */
export class PeltLight {
	/** Of shaders, by their names. */
	readonly uniforms: Record<string, IUniform>;
	/** Mean curves, and the dry pelt's weights of them, in format 2.x. */
	readonly means: SlabMeanCurves | undefined;
	readonly #texels: Texels;
	readonly #planes: readonly Texture[];
	readonly #layers: number;
	readonly #fin: boolean;
	/** Whose table of curves it shares. */
	readonly #leader: PeltLight | undefined;
	readonly #slabLight: SlabLight | undefined;
	#trimLight: TrimLight | undefined;
	/** What is told of the slabs of the states that the textures hold. */
	#states: readonly SlabState[];
	/** Stand-ins of the slabs of cut fur. */
	#places: ArrayLike<number> | undefined;

	/** @param planes of the coefficients @param layers slabs of the pelt @param fin whether the frame is a fin's */
	constructor(texels: Texels, planes: readonly Texture[], layers: number, fin: boolean, leader?: PeltLight) {
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

	/** Where in whole fur slabs have the light that these have when a share is left of them. */
	places(share: number): Float64Array {
		return this.#trim().places(share);
	}

	/** Has slabs lit as at these places; undefined: as they are. */
	cut(places: Float64Array | undefined): void {
		if (places) this.#trim().set(places);
		this.#places = places;
		this.#weigh();
	}

	/** States that the textures hold, the driest first; those without weights have the dry pelt's. */
	show(states: readonly Partial<SlabState>[] = [this.means ?? {}]): void {
		const { means } = this;
		if (!means) return;
		this.#states = states.map(({ weights = means.weights, multiple }) => ({ weights, multiple }));
		this.#weigh();
	}

	/** Has slabs, of states that the textures hold, the mean light of those that stand in for them. */
	#weigh(): void {
		const { slabLight } = this.uniforms;
		const places = this.#places;
		if (!this.#slabLight || !slabLight) return;
		this.#slabLight.states = places ? this.#states.map((state) => standInState(state, places)) : this.#states;
		slabLight.value = this.#slabLight.texture;
	}

	/** Made from the texels that the material was made with: other states of the fur have their light changed alike. */
	#trim(): TrimLight {
		if (!this.#trimLight) {
			this.#trimLight = new TrimLight(this.#planes, this.#texels, this.#layers, this.#fin ? 1 : this.#layers);
			(this.uniforms.trimLight as IUniform).value = this.#trimLight.texture;
		}
		return this.#trimLight;
	}

	/** Frees what it has on the GPU. */
	dispose(): void {
		this.#trimLight?.texture.dispose();
		this.#slabLight?.texture.dispose();
		if (!this.#leader) (this.uniforms.curveTable as IUniform<Texture> | undefined)?.value.dispose();
	}
}
