/** Form of a packed place. */

/** Texels of its picture. */
export const [WIDTH, HEIGHT] = [48, 24];
/** Radiance of the brightest byte; bytes are square roots of radiance. */
export const BRIGHTEST = 6;

/** A place as JSON. */
export interface PackedPlace {
	/** nine coefficients of three channels */
	probe: number[];
	/** direction to its lamp, if there is one */
	direction?: number[];
	/** linear colour of the dragged lamp times its irradiance */
	colour: number[];
	others: { direction: number[]; colour: number[] }[];
	/** albedo of the ground */
	ground: number[];
	/** three bytes a texel, rows from below, as base64 */
	picture: string;
}
