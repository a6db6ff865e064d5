/** Opening: a square of fur to drag the lamp over, before a word is read. */

import { loadFurry } from '../data/assets.ts';
import type { Mount } from '../lesson.ts';
import { FurPatch } from '../patch.ts';
import { View } from '../view.ts';

const TILES = 3;

export const mount: Mount = async (place, lesson) => {
	const { fur } = await loadFurry('pelt-fox', lesson);
	const patch = new FurPatch(fur, TILES);
	const view = new View(place, lesson, {
		label: lesson.words.hello,
		aspect: 16 / 7,
		azimuth: 28,
		elevation: 30,
		zoom: 1.5,
		centre: patch.middle,
		radius: TILES * 0.62,
	});
	view.add(patch);
};
