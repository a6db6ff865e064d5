/** Uniforms and defines of wet and dirty fur. */

import { Color, type IUniform, type Texture, Vector4 } from 'three';
import type { Pelt, RGB } from '../format.ts';
import { traitsOf } from '../planes/states.ts';

/** Wet or dirty fur. */
export interface Stained {
	/** Wetness and dirt; see FurWeather. */
	stains: Texture;
	/** Wet states in the textures, the driest first; with fewer than two nothing looks wet. */
	wet: readonly Pelt[];
	/** Linear colour of the dirt; undefined: nothing looks dirty. */
	mud: RGB | undefined;
	/** Number of states before the dirty one in the textures; undefined: the dirty one is not there, and dirt is colour alone. */
	clumps: number | undefined;
}

/** Uniforms of dry, clean fur. */
export const stainUniforms = (): Record<'stains' | 'wetnesses' | 'traits' | 'mud', IUniform> => ({
	stains: { value: null },
	wetnesses: { value: [] },
	traits: { value: [] },
	mud: { value: new Color() },
});

/**
 * Writes the uniforms.
 *
 * @returns values of the defines; undefined leaves one out
 */
export function stain(
	uniforms: Record<string, IUniform>,
	stained: Stained | undefined,
): Record<'WET' | 'DIRTY' | 'MUD', number | undefined> {
	const { stains, wetnesses, traits, mud } = uniforms as ReturnType<typeof stainUniforms>;
	stains.value = stained?.stains ?? null;
	if (!stained) return { WET: undefined, DIRTY: undefined, MUD: undefined };
	const { wet, clumps } = stained;
	wetnesses.value = wet.map(({ wetness = 0 }) => wetness);
	traits.value = wet.map((state) => new Vector4(...traitsOf(state)));
	if (stained.mud) mud.value.setRGB(...stained.mud);
	return {
		WET: wet.length > 1 ? wet.length : undefined,
		DIRTY: stained.mud && 1,
		MUD: stained.mud && clumps,
	};
}
