/** Fur between two baked states, and fur with mud. */

import { FurWeather } from '../../fur/index.ts';
import { controlRow, note, pane, panes, slider } from '../controls.ts';
import { loadFurry } from '../data/assets.ts';
import type { Mount } from '../lesson.ts';
import { FurPatch, tiled } from '../patch.ts';
import { View, type WindowOptions } from '../view.ts';
import { mixtureOf } from '../wet/mixture.ts';
import type { Words } from '../words/index.ts';

const PELT = 'pelt-fox';
const TILES = 3;
/** Squares of the mesh, few since light moments vary little on a plane. */
const CELLS = 6;
/** First wetness, half-way between two states. */
const FIRST_WETNESS = 0.625;
/** Gloss and light from behind of dry fur. */
const LOOK = { gloss: 0.12, backlight: 2 };
/** Spacing of shells over the best, since three pictures are drawn at a time. */
const COARSE = 1.5;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.wet;
	const { fur: pelt } = await loadFurry(PELT, lesson);
	// The mixture, and the states before and after it.
	const patches = [0, 1, 2].map(() => new FurPatch(pelt, TILES, tiled(TILES, CELLS)));
	const weathers = patches.map(({ fur, shells }) => {
		Object.assign(shells.material, LOOK);
		shells.coarseness = COARSE;
		return new FurWeather(fur);
	});
	await Promise.all(patches.map(({ fur }) => fur.loadStates()));
	const states = pelt.asset.pelts.filter(({ dirt }) => !dirt);
	const wetnesses = states.map(({ wetness }) => wetness ?? 0);
	if (wetnesses.length < 2) throw new Error(`models/${PELT}: got ${wetnesses.length} state, expected dry to soaked`);

	const [main] = patches as [FurPatch];
	const [weather, ...others] = weathers as [FurWeather, ...FurWeather[]];
	const look = { azimuth: 24, elevation: 38 };
	const view = new View(place, lesson, {
		label: words.picture,
		aspect: 16 / 9,
		...look,
		zoom: 1.3,
		centre: main.middle,
		radius: TILES * 0.62,
		...only(patches, 0),
	});
	const controls = controlRow(place);
	const says = note(place);
	const row = panes(place, 2);
	row.classList.add('below');
	const captions = words.neighbours.map((label, i) => {
		const { element, caption } = pane(row);
		view.window(element, { label, aspect: 16 / 10, ...look, zoom: 1.8, lamp: false, ...only(patches, i + 1) });
		return caption;
	});
	view.add(...patches);

	const now = { wetness: FIRST_WETNESS, dirt: 0 };
	const show = () => {
		Object.assign(weather, now);
		main.fur.update(0);
		// Mud counts as wetness, since it mats hairs as water does.
		const { drier, share } = mixtureOf(wetnesses, weather.wettest);
		for (const [i, other] of others.entries()) {
			other.wetness = wetnesses[drier + i] ?? 0;
			patches[i + 1]?.fur.update(0);
		}
		for (const [i, caption] of captions.entries())
			caption.textContent = words.share(words.states[drier + i] ?? '', i ? share : 1 - share);
		const of = (name: 'length' | 'shade') =>
			(1 - share) * (states[drier]?.[name] ?? 1) + share * (states[drier + 1]?.[name] ?? 1);
		says.textContent = words.hair(of('length'), of('shade'));
		view.redraw();
	};
	sliders(controls, words, now, show);
};

/** Window that shows only one of the patches. */
const only = (patches: readonly FurPatch[], shown: number): Pick<WindowOptions, 'before'> => ({
	before() {
		for (const [i, patch] of patches.entries()) patch.visible = i === shown;
	},
});

/** Sliders of wetness and dirt. */
function sliders(
	controls: HTMLElement,
	words: Words['wet'],
	now: Record<'wetness' | 'dirt', number>,
	show: () => void,
): void {
	slider(controls, {
		label: words.wetness,
		min: 0,
		max: 1,
		step: 0.025,
		value: now.wetness,
		text: words.amount,
		input: (value) => {
			now.wetness = value;
			show();
		},
	});
	slider(controls, {
		label: words.dirt,
		min: 0,
		max: 1,
		step: 0.01,
		value: now.dirt,
		text: words.amount,
		input: (value) => {
			now.dirt = value;
			show();
		},
	});
}
