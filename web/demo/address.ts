/**
 * The view as a link: what the page shows, and how it stands in the address.
 *
 *     ?model=bunny&preset=fox&method=ptm&split=lengyel,0.5&light=0.3,0.8,0.5&camera=30,12,1&wind=0.4,90&still=1
 *
 * - model: a name from models/models.json, or a path or address of a baked folder
 * - preset: the pelt that the model wears; without it the one that it was baked with
 * - method: how the hairs are lit; split=METHOD,SHARE: by another one to the right of that share of the window's width
 * - light: direction from the model to the lamp, world axes (x right, y up, z towards the first camera); any length
 * - lights: lamps, of which the others stand around the first
 * - camera: azimuth and elevation in degrees, distance in units of the distance at which the model fits the window.
 *   So a link shows the same view in a window of any shape. 0,0,1 looks along -z.
 * - shells: number of drawn shells, without it as many as the picture needs; fins=0: none
 * - length, density: of the hairs, in units of what was baked; colour=RRGGBB,RRGGBB: of root and tip, sRGB
 * - planes: texels of the fur, 64: as the model has them, 128: the preset's own, auto: these where the device is up to it
 * - env: a place whose light falls on the model, or none: the page's own sky
 * - crowd: so many bodies of the model, on a meadow
 * - wind=STRENGTH,DIRECTION: 0 to 1, and where it blows to: degrees as of the camera's azimuth, 90 is to the right
 * - wet, dirt: of the whole fur, 0 to 1; turn=1: the body turns as on a turntable
 * - still=1: nothing moves by itself, and wind bends the fur without gusts
 * - ui=0: the picture alone; lang: the language, whatever the browser prefers
 */

import { isLanguage, type Language } from '../page/language.ts';
import { type EnvironmentName, isEnvironment } from './environments.ts';
import { isPlanes, type Planes } from './fine.ts';

export type Triple = [number, number, number];

/** Ways to light the fur: those of the library, and its own with light curves found for this very fur. */
export const methods = ['ptm', 'eigen', 'lengyel', 'shadow-layers', 'unlit'] as const;

export type Method = (typeof methods)[number];

/** What is undefined is left to the page. */
export interface View {
	model?: string | undefined;
	preset?: string | undefined;
	method?: Method | undefined;
	/** share of the window's width where the other method begins, 0..1 */
	split?: { method: Method; share: number } | undefined;
	/** unit vector */
	light?: Triple | undefined;
	/** 1..8 */
	lights?: number | undefined;
	/** azimuth -180..180 degrees, elevation -90..90 degrees, distance 0.001..10: near a body of a large crowd it is small */
	camera?: Triple | undefined;
	/** 1..256 */
	shells?: number | undefined;
	fins?: boolean | undefined;
	/** 0.2..1.5 */
	length?: number | undefined;
	/** 0.2..2 */
	density?: number | undefined;
	/** root and tip, sRGB as rrggbb */
	colour?: [root: string, tip: string] | undefined;
	planes?: Planes | undefined;
	env?: EnvironmentName | 'none' | undefined;
	/** 1..400 */
	crowd?: number | undefined;
	/** strength 0..1, and where it blows to: 0..360 degrees from the first camera's side by way of the right */
	wind?: [strength: number, direction: number] | undefined;
	/** of all of the fur, 0..1 */
	wet?: number | undefined;
	dirt?: number | undefined;
	turn?: boolean | undefined;
	still: boolean;
	ui: boolean;
	lang?: Language | undefined;
}

/** A parameter that was ignored: without `expected` there is none of that name. */
export interface Problem {
	name: string;
	text: string;
	expected?: Expected;
}

/** Kinds of values; what they are called is up to the language. */
export type Expected =
	| 'model'
	| 'preset'
	| 'method'
	| 'split'
	| 'light'
	| 'lights'
	| 'camera'
	| 'shells'
	| 'flag'
	| 'length'
	| 'density'
	| 'colour'
	| 'planes'
	| 'env'
	| 'crowd'
	| 'wind'
	| 'wet'
	| 'dirt'
	| 'lang';

interface Parameter<Value> {
	expected: Expected;
	/** @returns undefined where the text is no such value */
	read(text: string): Value | undefined;
	write(value: Value): string;
}

const isMethod = (text: string): text is Method => (methods as readonly string[]).includes(text);

/** Finite numbers; an empty one is none. */
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

function whole(expected: Expected, most: number): Parameter<number> {
	return {
		expected,
		read: (text) => (/^\d+$/.test(text) && Number(text) >= 1 && Number(text) <= most ? Number(text) : undefined),
		write: String,
	};
}

function between(expected: Expected, least: number, most: number): Parameter<number> {
	return {
		expected,
		read: (text) => {
			const [value = Number.NaN] = numbers(text, 1) ?? [];
			return value >= least && value <= most ? value : undefined;
		},
		write: (value) => short(value, 2),
	};
}

function chosen<Value extends string>(expected: Expected, isOne: (text: string) => text is Value): Parameter<Value> {
	return { expected, read: (text) => (isOne(text) ? text : undefined), write: (value) => value };
}

const flag: Parameter<boolean> = {
	expected: 'flag',
	read: (text) => (text === '0' || text === '1' ? text === '1' : undefined),
	write: (value) => String(Number(value)),
};

/** In the order in which an address has them. */
const parameters: { [Name in keyof View]-?: Parameter<NonNullable<View[Name]>> } = {
	model: {
		expected: 'model',
		read: (text) => text || undefined,
		// A path stays readable: a query may hold slashes and colons as they are.
		write: (name) => encodeURIComponent(name).replaceAll('%2F', '/').replaceAll('%3A', ':'),
	},
	preset: {
		expected: 'preset',
		read: (text) => (/^[a-z][a-z0-9-]*$/.test(text) ? text : undefined),
		write: (name) => name,
	},
	method: chosen('method', isMethod),
	split: {
		expected: 'split',
		read: (text) => {
			const [method = '', ...rest] = text.split(',');
			const [share = Number.NaN] = numbers(rest.join(), 1) ?? [];
			return isMethod(method) && share >= 0 && share <= 1 ? { method, share } : undefined;
		},
		write: ({ method, share }) => `${method},${short(share, 3)}`,
	},
	light: {
		expected: 'light',
		read: (text) => {
			const direction = numbers(text, 3);
			const length = Math.hypot(...(direction ?? [0]));
			if (!direction || length < 1e-6 || !Number.isFinite(length)) return undefined;
			return direction.map((part) => part / length) as Triple;
		},
		write: (direction) => direction.map((part) => short(part, 3)).join(),
	},
	lights: whole('lights', 8),
	camera: {
		expected: 'camera',
		read: (text) => {
			const [azimuth = 0, elevation = 0, distance = 0] = numbers(text, 3) ?? [];
			if (Math.abs(elevation) > 90 || distance < 1e-3 || distance > 10) return undefined;
			return [wrapped(azimuth), elevation, distance];
		},
		write: ([azimuth, elevation, distance]) =>
			`${short(azimuth, 2)},${short(elevation, 2)},${Number(distance.toPrecision(4))}`,
	},
	shells: whole('shells', 256),
	fins: flag,
	length: between('length', 0.2, 1.5),
	density: between('density', 0.2, 2),
	colour: {
		expected: 'colour',
		read: (text) => {
			const [, root, tip] = /^([\da-f]{6}),([\da-f]{6})$/i.exec(text) ?? [];
			return root && tip ? [root.toLowerCase(), tip.toLowerCase()] : undefined;
		},
		write: (colours) => colours.join(),
	},
	planes: chosen('planes', isPlanes),
	env: chosen('env', (text): text is EnvironmentName | 'none' => text === 'none' || isEnvironment(text)),
	crowd: whole('crowd', 400),
	wind: {
		expected: 'wind',
		read: (text) => {
			const [strength = Number.NaN, direction = 0] = numbers(text, 2) ?? [];
			return strength >= 0 && strength <= 1 ? [strength, ((direction % 360) + 360) % 360] : undefined;
		},
		write: ([strength, direction]) => `${short(strength, 2)},${short(direction, 1)}`,
	},
	wet: between('wet', 0, 1),
	dirt: between('dirt', 0, 1),
	turn: flag,
	still: flag,
	ui: flag,
	lang: chosen('lang', isLanguage),
};

const names = Object.keys(parameters) as (keyof View)[];

/** What is left out of an address. */
const defaults: View = { still: false, ui: true };

/**
 * @param search the address's query, with or without its question mark
 * @returns the view, and each parameter that was ignored
 */
export function parseAddress(search: string): { view: View; problems: Problem[] } {
	const view: View = { ...defaults };
	const problems: Problem[] = [];
	for (const [name, text] of new URLSearchParams(search)) {
		const known = names.find((own) => own === name);
		const value = known && parameters[known].read(text);
		if (known && value !== undefined) Object.assign(view, { [known]: value });
		else problems.push({ name, text, ...(known && { expected: parameters[known].expected }) });
	}
	return { view, problems };
}

/** @returns the query with its question mark, or nothing where the view is the page's own */
export function formatAddress(view: View): string {
	const parts = names.flatMap((name) => {
		const value = view[name];
		if (value === undefined || value === defaults[name]) return [];
		return `${name}=${(parameters[name] as Parameter<unknown>).write(value)}`;
	});
	return parts.length ? `?${parts.join('&')}` : '';
}

/** Writes the view into the address bar, not more often than browsers allow. */
export function addressWriter(): (view: View) => void {
	let timer: ReturnType<typeof setTimeout> | undefined;
	return (view) => {
		clearTimeout(timer);
		timer = setTimeout(() => history.replaceState(null, '', formatAddress(view) || location.pathname), 400);
	};
}
