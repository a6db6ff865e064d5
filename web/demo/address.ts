/**
 * The view as a link: what the page shows, and how it stands in the address.
 *
 *     ?model=bunny&env=sunset&light=0.3,0.8,0.5&camera=30,12,1&shells=48&fins=0&still=1&ui=0
 *
 * - model: a name from models/models.json, or a path or address of a baked folder
 * - env: a place whose light falls on the model, or none: the page's own sky
 * - light: direction from the model to the lamp, world axes (x right, y up, z towards the first camera); any length
 * - camera: azimuth and elevation in degrees, distance in units of the distance at which the model fits the window.
 *   So a link shows the same view in a window of any shape. 0,0,1 looks along -z.
 * - shells: number of drawn shells, without it as many as the picture needs; fins=0: none
 * - crowd: so many bodies of the model, on a meadow
 * - still=1: nothing moves by itself; ui=0: the picture alone
 */

import { type EnvironmentName, environments, isEnvironment } from './environments.ts';

export type Triple = [number, number, number];

/** What is undefined is left to the page. */
export interface View {
	model?: string;
	env?: EnvironmentName | 'none';
	/** unit vector */
	light?: Triple;
	/** azimuth -180..180 degrees, elevation -90..90 degrees, distance 0.1..10 */
	camera?: Triple;
	/** 1..256 */
	shells?: number;
	fins?: boolean;
	/** 1..400 */
	crowd?: number;
	still: boolean;
	ui: boolean;
}

type Reader = (text: string, view: View) => boolean;

/** Three finite numbers; an empty one is none. */
function triple(text: string): Triple | undefined {
	const parts = text.split(',');
	const numbers = parts.map(Number);
	const good = numbers.length === 3 && parts.every((part) => part.trim() !== '') && numbers.every(Number.isFinite);
	return good ? (numbers as Triple) : undefined;
}

function flag(text: string, set: (value: boolean) => void): boolean {
	if (text !== '0' && text !== '1') return false;
	set(text === '1');
	return true;
}

/** Each parameter: what is expected, and a reader that returns false where it is not. */
const parameters: Record<keyof View, [expected: string, read: Reader]> = {
	model: [
		'the name or the folder of a model',
		(text, view) => {
			if (text === '') return false;
			view.model = text;
			return true;
		},
	],
	env: [
		`none, ${Object.keys(environments).join(', ')}`,
		(text, view) => {
			if (text !== 'none' && !isEnvironment(text)) return false;
			view.env = text;
			return true;
		},
	],
	light: [
		'a direction x,y,z',
		(text, view) => {
			const direction = triple(text);
			const length = direction ? Math.hypot(...direction) : 0;
			if (!direction || length < 1e-6 || !Number.isFinite(length)) return false;
			view.light = direction.map((part) => part / length) as Triple;
			return true;
		},
	],
	camera: [
		'azimuth,elevation,distance: degrees, degrees within ±90, 0.1 to 10',
		(text, view) => {
			const camera = triple(text);
			if (!camera || Math.abs(camera[1]) > 90 || camera[2] < 0.1 || camera[2] > 10) return false;
			view.camera = [wrapped(camera[0]), camera[1], camera[2]];
			return true;
		},
	],
	shells: [
		'a whole number from 1 to 256',
		(text, view) => {
			const shells = Number(text);
			if (!/^\d+$/.test(text) || shells < 1 || shells > 256) return false;
			view.shells = shells;
			return true;
		},
	],
	fins: [
		'0 or 1',
		(text, view) =>
			flag(text, (value) => {
				view.fins = value;
			}),
	],
	crowd: [
		'a whole number from 1 to 400',
		(text, view) => {
			const crowd = Number(text);
			if (!/^\d+$/.test(text) || crowd < 1 || crowd > 400) return false;
			view.crowd = crowd;
			return true;
		},
	],
	still: [
		'0 or 1',
		(text, view) =>
			flag(text, (value) => {
				view.still = value;
			}),
	],
	ui: [
		'0 or 1',
		(text, view) =>
			flag(text, (value) => {
				view.ui = value;
			}),
	],
};

/** Degrees in -180..180. */
function wrapped(degrees: number): number {
	if (Math.abs(degrees) <= 180) return degrees;
	return ((((degrees + 180) % 360) + 360) % 360) - 180;
}

/**
 * @param search the address's query, with or without its question mark
 * @returns the view, and a sentence for each parameter that was ignored
 */
export function parseAddress(search: string): { view: View; problems: string[] } {
	const view: View = { still: false, ui: true };
	const problems: string[] = [];
	for (const [name, text] of new URLSearchParams(search)) {
		const parameter = Object.hasOwn(parameters, name) ? parameters[name as keyof View] : undefined;
		if (!parameter) problems.push(`${name}: no such parameter, ignored`);
		else if (!parameter[1](text, view)) problems.push(`${name}=${text}: expected ${parameter[0]}; ignored`);
	}
	return { view, problems };
}

/** At most `digits` decimals, without trailing zeros and without -0. */
function short(value: number, digits: number): string {
	return String(Number(value.toFixed(digits)) + 0);
}

/** @returns the query with its question mark, or nothing where the view is the page's own */
export function formatAddress(view: View): string {
	const parts: string[] = [];
	// A path stays readable: a query may hold slashes and colons as they are.
	if (view.model !== undefined)
		parts.push(`model=${encodeURIComponent(view.model).replaceAll('%2F', '/').replaceAll('%3A', ':')}`);
	if (view.env) parts.push(`env=${view.env}`);
	if (view.light) parts.push(`light=${view.light.map((part) => short(part, 3)).join(',')}`);
	if (view.camera) {
		const [azimuth, elevation, distance] = view.camera;
		parts.push(`camera=${short(azimuth, 1)},${short(elevation, 1)},${short(distance, 3)}`);
	}
	if (view.shells !== undefined) parts.push(`shells=${view.shells}`);
	if (view.fins !== undefined) parts.push(`fins=${Number(view.fins)}`);
	if (view.crowd !== undefined) parts.push(`crowd=${view.crowd}`);
	if (view.still) parts.push('still=1');
	if (!view.ui) parts.push('ui=0');
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
