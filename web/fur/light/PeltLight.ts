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
	/** Texels of each fur. */
	readonly #texels: readonly TexelCoding[];
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
	#places: readonly ArrayLike<number>[] | undefined;

	/** @param texels of each fur @param planes of the coefficients @param layers slabs of the pelt @param fin whether the frame is a fin's */
	constructor(
		texels: readonly TexelCoding[],
		planes: readonly Texture[],
		layers: number,
		fin: boolean,
		leader?: PeltLight,
	) {
		const [coat] = texels as [TexelCoding];
		const { means, basis } = coat;
		const furs = texels.flatMap((own) => own.means ?? []);
		this.means = means;
		this.#texels = texels;
		this.#planes = planes;
		this.#layers = layers;
		this.#fin = fin;
		this.#leader = leader;
		this.#states = furs;
		this.#slabLight = means && new SlabLight(basis, furs, furs, fin);
		this.uniforms = {
			...(means
				? {
						curveTable: leader?.uniforms.curveTable ?? { value: curveTable(furs.map(({ curves }) => curves)) },
						slabLight: { value: this.#slabLight?.texture },
					}
				: momentUniforms(coat, fin)),
			trimLight: { value: null },
		};
	}

	/** Places in whole fur with the light that the slabs of cut fur get; see `standIns`. */
	places(share: number): Float64Array[] {
		return this.#trim().places(share);
	}

	/** Shares of cut fur's height that are hardly seen and faint; see `hiddenShares`. @param share of the height that is left */
	hidden(share: number): readonly number[] {
		return this.#trim().hidden(share);
	}

	/** Light slabs as at these places; undefined: at their own. */
	cut(places: readonly Float64Array[] | undefined): void {
		if (places) this.#trim().set(places);
		this.#places = places;
		this.#weigh();
	}

	/** Show the states in the textures, the driest first; states without weights use the dry pelt's. */
	show(states: readonly (Partial<SlabState> & { name?: string })[] = [{ ...this.means, name: this.#dry }]): void {
		if (!this.means) return;
		this.#states = states.flatMap((state) =>
			this.#texels.flatMap(({ means, pelts }, fur) => {
				const own = fur === 0 ? state : pelts?.find(({ name }) => name === state.name);
				return means ? [{ weights: own?.weights ?? means.weights, multiple: own?.multiple }] : [];
			}),
		);
		this.#weigh();
	}

	/** Name of the dry state. */
	get #dry(): string {
		return this.#texels[0]?.pelts?.[0]?.name ?? '';
	}

	/** Give every slab the mean light of its stand-in. */
	#weigh(): void {
		const { slabLight } = this.uniforms;
		const places = this.#places;
		if (!this.#slabLight || !slabLight) return;
		this.#slabLight.states = places
			? this.#states.map((state, i) => standInState(state, places[i % places.length] as ArrayLike<number>))
			: this.#states;
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
