/** Daylight of the pages: the key light that is dragged, and the sky. */

import { Color, HemisphereLight } from 'three';

/**
 * Irradiance of a white key light across its rays: most fur that faces it is then as bright as its picked colour. A white
 * matt surface has a radiance of 2.4.
 */
export const KEY_POWER = 2.4 * Math.PI;

/** Linear colour of the key light times its irradiance. */
export const KEY_COLOUR: Readonly<Color> = new Color(1, 0.95, 0.87).multiplyScalar(KEY_POWER);

/** Blue from above, warm from the ground. */
export function daylightSky(): HemisphereLight {
	return new HemisphereLight(new Color(0.55, 0.65, 0.8), new Color(0.28, 0.24, 0.2), KEY_POWER / 4);
}
