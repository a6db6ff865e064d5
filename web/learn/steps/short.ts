/** The article's figure 5: on short fur it matters less where the light comes from. */

import { Object3D, Vector3 } from 'three';
import { pane, panes } from '../controls.ts';
import { lit, onTile, seenFromAbove } from '../data/above.ts';
import { ARTICLE_FORM, loadFurry } from '../data/assets.ts';
import type { Mount } from '../lesson.ts';
import { FurPatch } from '../patch.ts';
import { View } from '../view.ts';

const TILES = 2;
/** Steps of a turn of the light. */
const STEPS = 36;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.short;
	const row = panes(place, 2);
	const pelts = await Promise.all([ARTICLE_FORM, 'pelt-short'].map((name) => loadFurry(name, lesson)));
	for (const [i, { fur }] of pelts.entries()) {
		const patch = new FurPatch(fur, TILES);
		const coefficients = seenFromAbove(fur);
		const { element, caption } = pane(row);
		const view = new View(element, lesson, {
			label: words.pictures[i] ?? '',
			aspect: 4 / 3,
			azimuth: 20,
			elevation: 40,
			zoom: 1.1,
			centre: new Vector3(0, patch.height / 2, 0),
			radius: TILES * 0.62,
		});
		view.add(patch);
		lesson.light.listen((direction) => {
			const [least, most] = around(coefficients, direction);
			const text = words.swing(fur.asset.height, (most - least) / (most + least));
			if (caption.textContent !== text) caption.textContent = text;
		});
	}
};

/** Smallest and largest L over a turn of the light at its height. */
function around(coefficients: readonly number[], direction: Readonly<Vector3>): [least: number, most: number] {
	const light = new Vector3();
	const values = Array.from({ length: STEPS }, (_, i) => {
		light.copy(direction).applyAxisAngle(Object3D.DEFAULT_UP, (i / STEPS) * 2 * Math.PI);
		return lit(coefficients, onTile(light));
	});
	return [Math.min(...values), Math.max(...values)];
}
