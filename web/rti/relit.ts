/** A picture that answers to light: planes of bytes, and what each of them counts under a light. Free of three. */

/** Unit vector to the lamp: right, up, at the eye. */
export type Light = readonly [u: number, v: number, z: number];

/** Every `stride`th byte of the data from `offset` on, a pixel each, row by row. */
export interface Plane {
	data: Uint8Array | Uint8ClampedArray;
	stride: number;
	offset: number;
}

export interface Relit {
	width: number;
	height: number;
	planes: Plane[];
	/** Value of a plane: scale · (byte / 255 − bias), of 1. */
	scale: number[];
	bias: number[];
	/** Factors of R, G and B by which the light is multiplied; undefined: it has its colour itself. */
	colour?: Plane[];
	/** True where the first row is on top. */
	topDown: boolean;
	/** R, G and B without any plane, then what each plane counts for them. */
	weigh(light: Light): number[];
}

/** Reasons why a file is none. */
export type RelitProblem = 'noPtm' | 'ptmKind' | 'header' | 'short' | 'plane' | 'large' | 'relightKind' | 'info';

export class RelitError extends Error {
	override readonly name = 'RelitError';

	/** @param detail kind or name that was got */
	constructor(
		readonly problem: RelitProblem,
		readonly detail = '',
	) {
		super(`${problem} ${detail}`.trim());
	}
}

/** Decoded picture: four bytes a pixel, the first row on top. */
export interface Pixels {
	width: number;
	height: number;
	data: Uint8ClampedArray;
}

/** Decoder of PNG and JPEG. */
export type Decode = (file: Blob) => Promise<Pixels>;

/** Most bytes of planes that are held in memory. */
export const MAX_BYTES = 600e6;

/** Lights behind the picture are held on its horizon: no polynomial follows them. */
export function held([u, v, z]: Light): Light {
	if (z >= 0) return [u, v, z];
	const across = Math.max(Math.hypot(u, v), 1e-9);
	return [u / across, v / across, 0];
}

/** Weights of planes that count the same for R, G and B. */
export const alike = (functions: readonly number[]): number[] => [0, 0, 0, ...functions.flatMap((f) => [f, f, f])];

/** Weights of planes for R, G and B in turn, three for each function. */
export const interleaved = (functions: readonly number[]): number[] => [
	...[0, 0, 0],
	...functions.flatMap((f) => [f, 0, 0, 0, f, 0, 0, 0, f]),
];

/**
 * What the picture has at one of its pixels, 0..1 in the coding of its photographs: the arithmetic of the shader.
 *
 * @param x column; @param y row from below
 */
export function relitAt(picture: Relit, light: Light, x: number, y: number): [r: number, g: number, b: number] {
	const { width, height, planes, scale, bias, colour, topDown } = picture;
	const weights = picture.weigh(held(light));
	const pixel = (topDown ? height - 1 - y : y) * width + x;
	const byteOf = ({ data, stride, offset }: Plane) => (data[pixel * stride + offset] as number) / 255;
	return [0, 1, 2].map((channel) => {
		let sum = weights[channel] as number;
		planes.forEach((plane, i) => {
			sum += (scale[i] as number) * (byteOf(plane) - (bias[i] as number)) * (weights[3 * i + 3 + channel] as number);
		});
		return Math.min(Math.max(sum * (colour ? byteOf(colour[channel] as Plane) : 1), 0), 1);
	}) as [number, number, number];
}
