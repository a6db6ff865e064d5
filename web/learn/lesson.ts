/** Context and type of the lesson's steps. */

import type { Language } from '../page/language.ts';
import type { Painter } from '../scene/Painter.ts';
import type { Calm } from './calm.ts';
import type { SharedLight } from './light.ts';
import type { Words } from './words/index.ts';

export interface Lesson {
	readonly language: Language;
	readonly words: Words;
	/** While it is on nothing moves by itself; always with `still=1` in the address. */
	readonly calm: Calm;
	/** Light shared by all figures. */
	readonly light: SharedLight;
	readonly painter: Painter;
}

/**
 * Builds a figure in `place`, above its caption. Resolves when everything for the first picture is there; rejects with an
 * Error whose message is for the reader.
 */
export type Mount = (place: HTMLElement, lesson: Lesson) => Promise<void>;
