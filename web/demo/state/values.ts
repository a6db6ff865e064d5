/** Values in an address: text → value → text, by kind. */

import type { Method, Triple, View } from './view.ts';
import { METHODS } from './view.ts';

/** Kinds of values; the words for them are those of the page's language. */
export type Kind =
	| 'model'
	| 'preset'
	| 'clip'
	| 'choice'
	| 'split'
	| 'light'
	| 'camera'
	| 'target'
	| 'whole'
	| 'number'
	| 'flag'
	| 'colour'
	| 'planes'
	| 'wind'
	| 'lang';

/** How a value stands in the address. */
export interface Value<Type> {
	kind: Kind;
	/** Bounds or names, for the words that say what was expected. */
	limits: readonly string[];
	/** @returns undefined for a text that is no such value */
	read(text: string): Type | undefined;
	write(value: Type): string;
}

/** Finite numbers; empty text is no number. */
function numbers(text: string, count: number): number[] | undefined {
	const parts = text.split(',');
	const values = parts.map(Number);
	const good = values.length === count && parts.every((part) => part.trim() !== '') && values.every(Number.isFinite);
	return good ? values : undefined;
}

/** At most `digits` decimals, without trailing zeros and without -0. */
function short(value: number, digits: number): string {
	return String(Number(value.toFixed(digits)) + 0);
}

/** Degrees in -180..180. */
function wrapped(degrees: number): number {
	if (Math.abs(degrees) <= 180) return degrees;
	return ((((degrees + 180) % 360) + 360) % 360) - 180;
}

const isMethod = (text: string): text is Method => (METHODS as readonly string[]).includes(text);

/** A whole number from 1. */
export function whole(max: number): Value<number> {
	return {
		kind: 'whole',
		limits: ['1', String(max)],
		read: (text) => (/^\d+$/.test(text) && Number(text) >= 1 && Number(text) <= max ? Number(text) : undefined),
		write: String,
	};
}

export function number(min: number, max: number, digits = 2): Value<number> {
	return {
		kind: 'number',
		limits: [String(min), String(max)],
		read: (text) => {
			const [value = Number.NaN] = numbers(text, 1) ?? [];
			return value >= min && value <= max ? value : undefined;
		},
		write: (value) => short(value, digits),
	};
}

export function choice<Name extends string>(names: readonly Name[], kind: Kind = 'choice'): Value<Name> {
	return { kind, limits: [names.join(', ')], read: (text) => names.find((name) => name === text), write: String };
}

export const flag: Value<boolean> = {
	kind: 'flag',
	limits: [],
	read: (text) => (text === '0' || text === '1' ? text === '1' : undefined),
	write: (value) => String(Number(value)),
};

export const model: Value<string> = {
	kind: 'model',
	limits: [],
	read: (text) => text || undefined,
	// A path stays readable: a query may hold slashes and colons as they are.
	write: (name) => encodeURIComponent(name).replaceAll('%2F', '/').replaceAll('%3A', ':'),
};

export const preset: Value<string> = {
	kind: 'preset',
	limits: [],
	read: (text) => (/^[a-z][a-z0-9-]*$/.test(text) ? text : undefined),
	write: (name) => name,
};

export const clip: Value<string> = {
	kind: 'clip',
	limits: [],
	read: (text) => text || undefined,
	write: encodeURIComponent,
};

export const split: Value<NonNullable<View['split']>> = {
	kind: 'split',
	limits: [METHODS.join(', ')],
	read: (text) => {
		const [method = '', ...rest] = text.split(',');
		const [share = Number.NaN] = numbers(rest.join(), 1) ?? [];
		return isMethod(method) && share >= 0 && share <= 1 ? { method, share } : undefined;
	},
	write: ({ method, share }) => `${method},${short(share, 3)}`,
};

/** A direction of any length, read as a unit vector. */
export const light: Value<Triple> = {
	kind: 'light',
	limits: [],
	read: (text) => {
		const direction = numbers(text, 3);
		const length = Math.hypot(...(direction ?? [0]));
		if (!direction || length < 1e-6 || !Number.isFinite(length)) return undefined;
		return direction.map((part) => part / length) as Triple;
	},
	write: (direction) => direction.map((part) => short(part, 3)).join(),
};

export const camera: Value<Triple> = {
	kind: 'camera',
	limits: [],
	read: (text) => {
		const [azimuth = 0, elevation = 0, distance = 0] = numbers(text, 3) ?? [];
		if (Math.abs(elevation) > 90 || distance < 1e-3 || distance > 10) return undefined;
		return [wrapped(azimuth), elevation, distance];
	},
	write: ([azimuth, elevation, distance]) =>
		`${short(azimuth, 2)},${short(elevation, 2)},${Number(distance.toPrecision(4))}`,
};

/** A point by shares of a box, from its middle to its sides and as far again. */
export const target: Value<Triple> = {
	kind: 'target',
	limits: [],
	read: (text) => {
		const point = numbers(text, 3);
		return point?.every((share) => Math.abs(share) <= 2) ? (point as Triple) : undefined;
	},
	write: (point) => point.map((share) => short(share, 3)).join(),
};

export const colours: Value<NonNullable<View['colour']>> = {
	kind: 'colour',
	limits: [],
	read: (text) => {
		const [, root, tip] = /^([\da-f]{6}),([\da-f]{6})$/i.exec(text) ?? [];
		return root && tip ? [root.toLowerCase(), tip.toLowerCase()] : undefined;
	},
	write: (pair) => pair.join(),
};

export const wind: Value<NonNullable<View['wind']>> = {
	kind: 'wind',
	limits: [],
	read: (text) => {
		const [strength = Number.NaN, direction = 0] = numbers(text, 2) ?? [];
		return strength >= 0 && strength <= 1 ? [strength, ((direction % 360) + 360) % 360] : undefined;
	},
	write: ([strength, direction]) => `${short(strength, 2)},${short(direction, 1)}`,
};
