/** The truth beside the rivals: the ring's hairs path-traced under four lamps, as pictures (`npm run pictures -- --truth`). */

import { MathUtils, Vector3 } from 'three';
import { pane } from '../controls.ts';
import type { Lesson } from '../lesson.ts';
import above from './above.webp';
import behind from './behind.webp';
import eye from './eye.webp';
import side from './side.webp';
import './style.css';
import view from './view.json';

export type LampName = keyof typeof view.lamps;
export const LAMP_NAMES = Object.keys(view.lamps) as LampName[];

const PICTURES: Readonly<Record<LampName, string>> = { above, side, behind, eye };
/** Largest angle between the lamp and a picture's own that counts as none, degrees. */
const NEAR = 1.5;

/** Unit vector towards a lamp, world axes. */
export function lampOf(name: LampName): Vector3 {
	return new Vector3(...(view.lamps[name] as [number, number, number])).normalize();
}

/** Lamp next to a direction, and the angle to it in degrees. */
export function nearestLamp(direction: Readonly<Vector3>): { name: LampName; off: number } {
	const all = LAMP_NAMES.map((name) => ({ name, off: MathUtils.radToDeg(lampOf(name).angleTo(direction)) }));
	return all.reduce((one, other) => (other.off < one.off ? other : one));
}

/** Shows the picture of the lamp next to the lesson's, pale where the two are apart. */
export function truthPane(row: Element, { light, words: { rivals: words } }: Lesson): void {
	const { element, caption } = pane(row);
	element.className = 'truth';
	const images = LAMP_NAMES.map((name) => {
		const image = element.appendChild(document.createElement('img'));
		Object.assign(image, { src: PICTURES[name], alt: words.truth.picture(words.lamps[name]), loading: 'lazy' });
		return { name, image };
	});
	const title = caption.appendChild(document.createElement('strong'));
	title.textContent = words.truth.name;
	const told = caption.appendChild(document.createElement('span'));
	light.listen((direction) => {
		const { name, off } = nearestLamp(direction);
		for (const each of images) each.image.hidden = each.name !== name;
		const same = off < NEAR;
		element.classList.toggle('elsewhere', !same);
		const text = ` ${same ? words.truth.costs : words.truth.elsewhere}`;
		if (told.textContent !== text) told.textContent = text;
	});
}
