/** Attributes of `<fur-view>` as text and as values. */

/** x, y, z, or azimuth, elevation, distance. */
export type Triple = [number, number, number];

/** Attributes that the element follows. */
export const ATTRIBUTES = [
	'src',
	'light',
	'camera',
	'preset',
	'clip',
	'paused',
	'environment',
	'controls',
	'alt',
	'aria-label',
	'lang',
] as const;

export type AttributeName = (typeof ATTRIBUTES)[number];

/** Range of the camera's elevation, degrees, and of its distance. */
const [MAX_ELEVATION, MIN_DISTANCE, MAX_DISTANCE] = [89.9, 0.25, 4];

function triple(text: string | null): Triple | undefined {
	const parts = (text ?? '').split(',');
	const numbers = parts.map((part) => (part.trim() === '' ? Number.NaN : Number(part)));
	return numbers.length === 3 && numbers.every(Number.isFinite) ? (numbers as Triple) : undefined;
}

/** Direction to the lamp; undefined for text that is none, and for no direction at all. */
export function parseLight(text: string | null): Triple | undefined {
	const direction = triple(text);
	return direction?.some((part) => part !== 0) ? direction : undefined;
}

/** Azimuth and elevation in degrees, distance; undefined for text that is none. */
export function parseCamera(text: string | null): Triple | undefined {
	const orbit = triple(text);
	return orbit && clampCamera(orbit);
}

/** An orbit within its range. */
export function clampCamera([azimuth, elevation, distance]: Triple): Triple {
	return [
		azimuth,
		Math.min(Math.max(elevation, -MAX_ELEVATION), MAX_ELEVATION),
		Math.min(Math.max(distance, MIN_DISTANCE), MAX_DISTANCE),
	];
}

/** How attributes of three numbers are read, and what is expected of them. */
export const TRIPLE = {
	light: { parse: parseLight, expected: 'x,y,z' },
	camera: { parse: parseCamera, expected: 'azimuth,elevation,distance' },
} as const;

/** Numbers as an attribute has them, to three places. */
export function format(numbers: Readonly<Triple>): string {
	return numbers.map((number) => String(Math.round(number * 1000) / 1000 + 0)).join(',');
}
