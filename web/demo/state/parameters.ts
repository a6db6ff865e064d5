/** The table of parameters: a row each, which drives the address, the panel and the table in the docs. */

import { type Abilities, choice, menu, slider, swatch, toggle, toggleOf } from './controls.ts';
import { type Parameter, ranged } from './parameter.ts';
import * as values from './values.ts';
import {
	ENVIRONMENTS,
	type EnvironmentName,
	isRival,
	LANGUAGE_NAMES,
	MAX_CROWD,
	MAX_LAMPS,
	METHODS,
	type Method,
	PLANES,
	type View,
} from './view.ts';

export type { Parameter, Part } from './parameter.ts';

type Table = { readonly [Name in keyof View]-?: Parameter<NonNullable<View[Name]>> };

/** Shells that the slider reaches; the address may ask for more. */
const MAX_SLIDER_SHELLS = 128;
/** Longest time into a clip, seconds. */
const MAX_TIME = 3600;
/** Wind blows to the right until a direction is chosen, degrees. */
const RIGHT = 90;
/** Share of the room's width at which a second method begins at first. */
const MIDDLE = 0.5;

const hasFur = ({ fur }: Abilities) => fur;
const isAlone = ({ fur, alone }: Abilities) => fur && alone;
const isAllowed = (method: string, { eigen, alone }: Abilities) =>
	method === 'none' || (method === 'eigen' ? eigen : alone || !isRival(method as Method));
const windOf = (strength: number, direction: number): Partial<View> => ({
	wind: strength === 0 && direction === RIGHT ? undefined : [strength, direction],
});

/** In the order in which an address has them; those of a folder of the panel in its order. */
export const parameters: Table = {
	model: {
		value: values.model,
		doc: ['bunny', 'Model of the menu, or path of a baked folder'],
		part: 'model',
		controls: [
			menu('body', 'model', {
				get: (_, shown) => shown.model,
				set: (name) => ({ model: name }),
			}),
		],
	},
	preset: {
		value: values.preset,
		doc: ['fox', 'Pelt of that preset in the place of the model’s own'],
		part: 'fur',
		controls: [
			menu('body', 'preset', {
				enabled: hasFur,
				get: (view) => view.preset ?? '',
				set: (name) => ({ preset: name || undefined }),
			}),
		],
	},
	method: {
		value: values.choice(METHODS),
		doc: ['ptm', 'Lighting method of the hairs'],
		part: 'fur',
		controls: [
			choice('light', 'method', {
				enabled: hasFur,
				names: METHODS,
				titles: 'methods',
				allowed: isAllowed,
				get: (view) => view.method ?? 'ptm',
				set: (method) => ({ method: method === 'ptm' ? undefined : (method as Method) }),
			}),
		],
	},
	split: {
		value: values.split,
		doc: ['lengyel,0.5', 'Another method right of that share of the window’s width, without what the panel covers'],
		part: 'fur',
		controls: [
			choice('light', 'split', {
				enabled: isAlone,
				names: ['none', ...METHODS],
				titles: 'methods',
				allowed: isAllowed,
				get: (view) => view.split?.method ?? 'none',
				set: (method, { split }) => ({
					split: method === 'none' ? undefined : { method: method as Method, share: split?.share ?? MIDDLE },
				}),
			}),
		],
	},
	light: {
		value: values.light,
		doc: ['-0.9,0.45,0.2', 'Direction to the lamp: x to the right, y up, z towards the first camera; any length'],
	},
	lights: ranged('lights', {
		...{ folder: 'light', label: 'lights', range: [1, MAX_LAMPS], step: 1, initial: 1 },
		doc: ['3', 'Lamps; the others stand around the first'],
	}),
	camera: {
		value: values.camera,
		doc: [
			'-20,10,0.9',
			'Azimuth and elevation in degrees; distance, 1 where the model fits what the controls leave of the window',
		],
	},
	target: {
		value: values.target,
		doc: ['0.6,-1,0.5', 'Point that the camera looks at: 0,0,0 the middle of the model’s box, 1 and -1 its sides'],
	},
	shells: {
		value: values.whole(256),
		doc: ['48', 'Number of drawn shells; without it as many as the picture needs'],
		controls: [
			toggle('hair', 'automatic', {
				enabled: isAlone,
				get: (view) => view.shells === undefined,
				set: (automatic, _, shown) => ({ shells: automatic ? undefined : shown.shells }),
			}),
			slider('hair', 'shells', {
				range: [1, MAX_SLIDER_SHELLS],
				step: 1,
				get: (view, shown) => view.shells ?? shown.shells,
				set: (shells) => ({ shells }),
				enabled: (able, { shells }) => isAlone(able) && shells !== undefined,
				// The automatic number changes with every zoom: the overlay shows it.
				visible: (view) => view.shells !== undefined,
			}),
		],
	},
	fins: {
		value: values.flag,
		doc: ['0', 'Fins at the outline, or none'],
		controls: [toggleOf('fins', true, { folder: 'hair', label: 'fins', enabled: ({ fins }) => fins })],
	},
	length: ranged('length', {
		...{ folder: 'hair', label: 'length', range: [0.2, 1.5], step: 0.01, initial: 1, enabled: hasFur },
		doc: ['0.4', 'Length of the hairs over what was baked; below 1 they are cut'],
	}),
	density: ranged('density', {
		...{ folder: 'hair', label: 'density', range: [0.2, 2], step: 0.01, initial: 1, enabled: hasFur },
		doc: ['0.8', 'Density of the hairs over what was baked'],
	}),
	colour: {
		value: values.colours,
		doc: ['402010,e8b98a', 'Colours of root and tip as they are seen, sRGB'],
		controls: [
			swatch('hair', 'root', {
				enabled: ({ root }) => root,
				get: ({ colour }, shown) => `#${(colour ?? shown.colour)[0]}`,
				set: (root, { colour }, shown) => ({ colour: [root.slice(1), (colour ?? shown.colour)[1]] }),
			}),
			swatch('hair', 'tip', {
				enabled: hasFur,
				get: ({ colour }, shown) => `#${(colour ?? shown.colour)[1]}`,
				set: (tip, { colour }, shown) => ({ colour: [(colour ?? shown.colour)[0], tip.slice(1)] }),
			}),
		],
	},
	planes: {
		value: values.choice(PLANES, 'planes'),
		doc: ['64', 'Texels of the fur: as the model was baked, its preset’s own, or these where the device is up to it'],
	},
	env: {
		value: values.choice(['none', ...ENVIRONMENTS]),
		doc: ['sunset', 'Environment whose light falls on the model; none is the page’s own sky'],
		part: 'environment',
		controls: [
			choice('light', 'environment', {
				names: ['none', ...ENVIRONMENTS],
				titles: 'environments',
				get: (_, shown) => shown.env,
				set: (name) => ({ env: name === 'none' ? undefined : (name as EnvironmentName) }),
			}),
		],
	},
	exposure: ranged('exposure', {
		...{ folder: 'light', label: 'exposure', range: [0.25, 4], step: 0.01, initial: 1 },
		doc: ['1.2', 'Exposure of the picture, a factor of its light'],
	}),
	crowd: ranged('crowd', {
		...{ folder: 'body', label: 'crowd', range: [1, MAX_CROWD], step: 1, initial: 1, enabled: hasFur },
		doc: ['100', 'Bodies of the model, side by side'],
		part: 'fur',
	}),
	wind: {
		value: values.wind,
		doc: ['0.5,90', 'Strength of the wind, 1 a storm; degrees that it blows to, 90 to the right'],
		controls: [
			slider('weather', 'wind', {
				range: [0, 1],
				step: 0.01,
				enabled: hasFur,
				get: ({ wind }) => wind?.[0] ?? 0,
				set: (strength, { wind }) => windOf(strength, wind?.[1] ?? RIGHT),
			}),
			slider('weather', 'direction', {
				range: [0, 360],
				step: 1,
				enabled: hasFur,
				get: ({ wind }) => wind?.[1] ?? RIGHT,
				set: (direction, { wind }) => windOf(wind?.[0] ?? 0, direction),
			}),
		],
	},
	wet: ranged('wet', {
		...{ folder: 'weather', label: 'wetness', range: [0, 1], step: 0.01, initial: 0, enabled: ({ wet }) => wet },
		doc: ['0.5', 'Wetness of all of the fur'],
	}),
	dirt: ranged('dirt', {
		...{ folder: 'weather', label: 'dirt', range: [0, 1], step: 0.01, initial: 0, enabled: ({ dirt }) => dirt },
		doc: ['0.3', 'Dirt on all of the fur'],
	}),
	turn: {
		value: values.flag,
		doc: ['1', 'The body turns as on a turntable'],
		controls: [
			toggleOf('turn', false, {
				...{ folder: 'weather', label: 'turntable' },
				enabled: ({ model, alone, calm }) => model && alone && !calm,
			}),
		],
	},
	clip: {
		value: values.clip,
		doc: ['Walk', 'Clip of a model that has some; without it the first'],
		controls: [
			menu('clips', 'clip', {
				get: ({ clip }, shown) => clip ?? shown.clip,
				set: (clip) => ({ clip }),
			}),
		],
	},
	time: {
		value: values.number(0, MAX_TIME, 3),
		doc: ['0.4', 'Seconds into the clip at which it is held; without it the clip plays'],
		controls: [
			toggle('clips', 'play', {
				enabled: ({ plays }) => plays,
				get: ({ time }) => time === undefined,
				set: (play, _, shown) => ({ time: play ? undefined : shown.time }),
			}),
			slider('clips', 'time', {
				range: [0, MAX_TIME],
				step: 0.01,
				most: ({ duration }) => duration,
				// Later than the end is the end.
				get: ({ time }, shown) => Math.min(time ?? shown.time, shown.duration),
				set: (time) => ({ time }),
			}),
		],
	},
	speed: ranged('speed', {
		...{ folder: 'clips', label: 'speed', range: [0.1, 3], step: 0.05, initial: 1, enabled: ({ plays }) => plays },
		doc: ['0.5', 'Speed of the clip, a factor of its own'],
	}),
	look: {
		value: values.flag,
		doc: ['0', 'A model with a joint named head looks at the lamp, or not'],
		controls: [toggleOf('look', true, { folder: 'clips', label: 'look', enabled: ({ looks }) => looks })],
	},
	details: { value: values.flag, doc: ['1', 'All figures of the picture beside its speed and shells, with graphs'] },
	still: { value: values.flag, doc: ['1', 'Nothing moves by itself, and wind bends the fur without gusts'] },
	ui: { value: values.flag, doc: ['0', 'The picture alone'] },
	lang: { value: values.choice(LANGUAGE_NAMES, 'lang'), doc: ['zh', 'Language; without it what the browser prefers'] },
};

/** Names of all parameters, in the table's order. */
export const NAMES = Object.keys(parameters) as (keyof View)[];
