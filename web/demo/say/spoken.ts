/** Words on the picture for those who do not see it: its name, and where lamp and camera go by the keyboard. */

import { MathUtils, Spherical, Vector3 } from 'three';
import type { Triple } from '../state/view.ts';
import { en } from '../words/spoken.en.ts';
import { zh } from '../words/spoken.zh.ts';

/** Milliseconds without a key after which a place is told: not at every step. */
const PAUSE = 600;

export interface Seen {
	/** Title of the model on show; undefined for none. */
	model(): string | undefined;
	/** Unit vector to the lamp, world axes. */
	lamp(): Triple;
	/** Azimuth and elevation in degrees, and the distance in units of the one at which the model fits. */
	camera(): Triple;
	/** Action of the arrow keys: `light`, `camera` or a tool's name. */
	act(): string;
}

const spherical = new Spherical();
const vector = new Vector3();

/** Names the picture, now and whenever another model has come, and tells what keys do. */
export function speak(picture: HTMLElement, language: 'en' | 'zh', seen: Seen): void {
	const words = { en, zh }[language];
	const keys = document.createElement('p');
	keys.id = 'keys';
	keys.textContent = words.keys;
	const said = document.createElement('p');
	said.setAttribute('aria-live', 'polite');
	keys.className = said.className = 'hidden';
	picture.after(keys, said);
	picture.setAttribute('aria-describedby', keys.id);

	let shown = seen.model();
	const name = () => picture.setAttribute('aria-label', shown === undefined ? words.nothing : words.shown(shown));
	name();
	new MutationObserver(() => {
		const model = seen.model();
		if (document.documentElement.dataset.state === 'loading' || model === shown) return;
		shown = model;
		name();
		if (model !== undefined) said.textContent = words.arrived(model);
	}).observe(document.documentElement, { attributeFilter: ['data-state'] });

	let waiting = 0;
	addEventListener('keydown', ({ key, defaultPrevented }) => {
		const act = seen.act();
		// Keys that the picture has taken: its own listeners come before.
		if (!defaultPrevented) return;
		clearTimeout(waiting);
		if (key === 'Enter' || key === ' ') said.textContent = words.painted[act] ?? '';
		else if ((act === 'light' && key.startsWith('Arrow')) || act === 'camera')
			waiting = window.setTimeout(() => {
				said.textContent = place(seen, words);
			}, PAUSE);
	});
}

/** Sentence on the place of what arrow keys move: the camera, or the lamp as the camera sees it. */
function place(seen: Seen, words: typeof en): string {
	const [azimuth, elevation, distance] = seen.camera();
	if (seen.act() === 'camera') return words.camera(...angles(azimuth, elevation, words), distance.toFixed(2));
	spherical.setFromVector3(vector.set(...seen.lamp()));
	const [turn, tilt] = [MathUtils.radToDeg(spherical.theta), 90 - MathUtils.radToDeg(spherical.phi)];
	return words.lamp(...angles(turn - azimuth, tilt, words));
}

/** Words of whole degrees to the side and up. */
function angles(azimuth: number, elevation: number, words: typeof en): [string, string] {
	const [aside, up] = [Math.round(MathUtils.euclideanModulo(azimuth + 180, 360) - 180), Math.round(elevation)];
	const side = aside > 0 ? words.right(aside) : words.left(-aside);
	const turned = aside === 0 ? words.front : Math.abs(aside) === 180 ? words.behind : side;
	return [turned, up < 0 ? words.below(-up) : words.above(up)];
}
