/** WeatherStates of a fur from dry to soaked, and the place of a wetness among them. Free of three. */

import type { FurAsset, Pelt } from '../format.ts';

/** WeatherStates of one fur, all of one λ and Ω, so that they can be mixed. */
export interface WeatherStates {
	/** Wet states by rising wetness, the dry one first. */
	wet: readonly [Pelt, ...Pelt[]];
	/** State of hairs fully covered with mud. */
	dirty: Pelt | undefined;
}

/** WeatherStates of an asset; further dry and clean pelts in it are not among them. */
export function statesOf({ pelts }: FurAsset): WeatherStates {
	const [dry, ...others] = pelts as [Pelt, ...Pelt[]];
	return { wet: [dry, ...others.filter(({ wetness }) => wetness)], dirty: others.find(({ dirt }) => dirt) };
}

/** Factors of a state's look, 1 each if dry: length, hairs' colour, strength and exponent of the highlights. */
export type Traits = readonly [length: number, shade: number, gloss: number, sharpness: number];

/** Factors of a state. */
export function traitsOf({ length = 1, shade = 1, gloss = 1, sharpness = 1 }: Pelt): Traits {
	return [length, shade, gloss, sharpness];
}

/**
 * The two states around a body whose wetness goes from `from` to `to`: the wettest that is no wetter than its driest
 * place, and the driest that is no drier than its wettest.
 *
 * @param wetnesses of the states, rising, the first 0
 * @returns the first state alone where all is dry, or where there is no other
 */
export function pairFor(wetnesses: readonly number[], from: number, to: number): number[] {
	if (to === 0 || wetnesses.length === 1) return [0];
	const drier = wetnesses.findLastIndex((wetness) => wetness <= from);
	const lower = Math.min(drier, wetnesses.length - 2);
	const wetter = wetnesses.findIndex((wetness) => wetness >= to);
	return [lower, Math.max(wetter < 0 ? wetnesses.length - 1 : wetter, lower + 1)];
}

/**
 * Place of a wetness among states: 1.25 is a quarter of the way from the second to the third; see weather.glsl.
 *
 * @param wetnesses of the states, rising
 */
export function placeOf(wetnesses: readonly number[], wetness: number): number {
	let place = 0;
	for (let i = 1; i < wetnesses.length; i++) {
		const [drier, wetter] = [wetnesses[i - 1] as number, wetnesses[i] as number];
		place += Math.min(Math.max((wetness - drier) / (wetter - drier), 0), 1);
	}
	return place;
}
