/** Shells. The same square of fur with few and many of them, from above and from the side. */

import { Vector3 } from 'three';
import { controlRow, note, slider } from '../controls.ts';
import { loadFurry } from '../data/assets.ts';
import type { Mount } from '../lesson.ts';
import { FurPatch } from '../patch.ts';
import { View } from '../view.ts';

const TILES = 2;
const MAX_SHELLS = 64;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.shells;
	const { fur } = await loadFurry('pelt-paper', lesson);
	const patch = new FurPatch(fur, TILES);
	const target = new Vector3(0, patch.height / 2, 0);
	const view = new View(place, lesson, {
		label: words.above,
		aspect: 16 / 7.4,
		azimuth: 24,
		elevation: 32,
		zoom: 1.3,
		centre: target,
		radius: TILES * 0.62,
	});
	const side = view.window(place, {
		label: words.side,
		aspect: 16 / 3.6,
		elevation: 4,
		zoom: 4.6,
		lamp: false,
		target: new Vector3(0, patch.height * 0.5, TILES / 2),
	});
	side.classList.add('below');
	view.add(patch);

	const row = controlRow(place);
	slider(row, {
		label: words.slider,
		min: 0,
		max: 12,
		step: 1,
		value: 8,
		text: (step) => words.count(shells(step)),
		input: (step) => {
			patch.shells.shellCount = shells(step);
			view.redraw();
		},
	});
	note(place);
};

/** 1, 2, 3, 4, 6, 8, … 64: half-steps of doubling. */
export function shells(step: number): number {
	return Math.min(Math.round(2 ** (step / 2)), MAX_SHELLS);
}
