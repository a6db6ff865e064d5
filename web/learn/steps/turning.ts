/** The article's figure 4: one square of fur, the light turned by quarters. */

import { MathUtils, Object3D, Vector3 } from 'three';
import { pane, panes } from '../controls.ts';
import { lit, onTile, seenFromAbove } from '../data/above.ts';
import { ARTICLE_FORM, loadFurry } from '../data/assets.ts';
import type { Mount } from '../lesson.ts';
import { FurPatch } from '../patch.ts';
import { View, type ViewOptions } from '../view.ts';

const TURNS = [0, 90, 180, 270];
const TILES = 1.5;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.turning;
	const { fur } = await loadFurry(ARTICLE_FORM, lesson);
	const patch = new FurPatch(fur, TILES);
	const coefficients = seenFromAbove(fur);
	const row = panes(place, TURNS.length);
	let view: View | undefined;
	for (const turn of TURNS) {
		const { element, caption } = pane(row);
		const options: ViewOptions = {
			label: words.picture(turn),
			aspect: 1,
			elevation: 62,
			zoom: 1.05,
			turn,
			centre: new Vector3(0, patch.height / 2, 0),
			radius: TILES * 0.64,
		};
		if (view) view.window(element, options);
		else view = new View(element, lesson, options);
		const light = new Vector3();
		lesson.light.listen((direction) => {
			light.copy(direction).applyAxisAngle(Object3D.DEFAULT_UP, MathUtils.degToRad(turn));
			const text = words.brightness(turn, lit(coefficients, onTile(light)));
			if (caption.textContent !== text) caption.textContent = text;
		});
	}
	view?.add(patch);
};
