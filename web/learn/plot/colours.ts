/** Colour maps: one for light, even in lightness for all eyes, and one for differences. */

import { interpolateInferno } from 'd3-scale-chromatic';

export type RGB = readonly [number, number, number];

const STEPS = 256;
/** Start of the map, above black. */
const DARKEST = 0.1;

const table: RGB[] = Array.from({ length: STEPS }, (_, i) => {
	const hex = interpolateInferno(DARKEST + ((1 - DARKEST) * i) / (STEPS - 1));
	const [r = 0, g = 0, b = 0] = [1, 3, 5].map((at) => Number.parseInt(hex.slice(at, at + 2), 16));
	return [r, g, b];
});

/** Colour of light L, by its root: most of the fur is dark beside its brightest tips. */
export function lightColour(light: number, peak: number): RGB {
	const share = Math.sqrt(Math.min(Math.max(light / peak, 0), 1));
	return table[Math.round(share * (STEPS - 1))] as RGB;
}

/** Colours of differences: blue for less, orange for more, grey for none. */
const NONE: RGB = [70, 76, 82];
const LESS: RGB = [120, 190, 255];
const MORE: RGB = [255, 170, 70];

/** @param share -1..1 */
export function differenceColour(share: number): RGB {
	const end = share < 0 ? LESS : MORE;
	const t = Math.min(Math.abs(share), 1);
	const mix = (i: 0 | 1 | 2) => Math.round(NONE[i] + (end[i] - NONE[i]) * t);
	return [mix(0), mix(1), mix(2)];
}

export const css = ([r, g, b]: RGB): string => `rgb(${r} ${g} ${b})`;
