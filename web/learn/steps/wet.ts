/** Step 11: fur between two of the states that were baked, and with mud on it. */

import { FurWeather } from '../../fur/index.ts';
import { loadFurry } from '../assets.ts';
import { controlRow, note, pane, panes, slider } from '../controls.ts';
import type { Mount } from '../lesson.ts';
import { FurPatch, tiled } from '../patch.ts';
import { View, type WindowOptions } from '../view.ts';
import { mixtureOf } from '../wet/mixture.ts';

const TILES = 3;
/** Of the mesh: the lights' moments vary little on a plane. */
const CELLS = 6;
/** Half-way between two states. */
const FIRST_WETNESS = 0.625;
/** Dry, how glossy it is, and how much light comes through. */
const LOOK = { gloss: 0.12, backlight: 2 };

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.wet;
	const { fur: pelt } = await loadFurry('pelt-fox', lesson);
	// What is drawn, and the states before and after it.
	const patches = [0, 1, 2].map(() => new FurPatch(pelt, TILES, tiled(TILES, CELLS)));
	const weathers = patches.map(({ fur, shells }) => {
		Object.assign(shells.material, LOOK);
		return new FurWeather(fur);
	});
	await Promise.all(patches.map(({ fur }) => fur.loadStates()));
	const states = pelt.asset.pelts.filter(({ dirt }) => !dirt);
	const wetnesses = states.map(({ wetness }) => wetness ?? 0);

	const [main] = patches as [FurPatch];
	const [weather, ...others] = weathers as [FurWeather, ...FurWeather[]];
	/** Of the three, which this window shows. */
	const only = (shown: number): Pick<WindowOptions, 'before'> => ({
		before() {
			for (const [i, patch] of patches.entries()) patch.visible = i === shown;
		},
	});
	const look = { azimuth: 24, elevation: 38 };
	const view = new View(place, lesson, {
		label: words.picture,
		aspect: 16 / 9,
		...look,
		zoom: 1.3,
		centre: main.middle,
		radius: TILES * 0.62,
		...only(0),
	});
	const row = panes(place, 2);
	row.classList.add('below');
	const captions = words.neighbours.map((label, i) => {
		const { element, caption } = pane(row);
		view.window(element, { label, aspect: 16 / 10, ...look, zoom: 1.8, lamp: false, ...only(i + 1) });
		return caption;
	});
	view.add(...patches);

	const controls = controlRow(place);
	const says = note(place);
	let [wetness, dirt] = [FIRST_WETNESS, 0];
	const show = () => {
		Object.assign(weather, { wetness, dirt }).update(0);
		// Mud mats hairs as water does.
		const { drier, share } = mixtureOf(wetnesses, weather.wettest);
		for (const [i, other] of others.entries()) {
			other.wetness = wetnesses[drier + i] ?? 0;
			other.update(0);
		}
		for (const [i, caption] of captions.entries())
			caption.textContent = words.share(words.states[drier + i] ?? '', i ? share : 1 - share);
		const of = (name: 'length' | 'shade') =>
			(1 - share) * (states[drier]?.[name] ?? 1) + share * (states[drier + 1]?.[name] ?? 1);
		says.textContent = words.hair(of('length'), of('shade'));
		view.redraw();
	};
	slider(controls, {
		label: words.wetness,
		min: 0,
		max: 1,
		step: 0.025,
		value: wetness,
		text: (value) => value.toFixed(3),
		input: (value) => {
			wetness = value;
			show();
		},
	});
	slider(controls, {
		label: words.dirt,
		min: 0,
		max: 1,
		step: 0.01,
		value: dirt,
		text: (value) => value.toFixed(2),
		input: (value) => {
			dirt = value;
			show();
		},
	});
};
