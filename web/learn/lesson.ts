/** Context and type of the lesson's steps. */

import type { Language } from '../page/language.ts';
import type { Painter } from '../scene/Painter.ts';
import type { SharedLight } from './light.ts';
import type { Words } from './words/index.ts';

export interface Lesson {
	readonly language: Language;
	readonly words: Words;
	/** Whether nothing moves by itself: reduced motion is preferred, or the address has `still=1`. */
	readonly calm: boolean;
	/** Light shared by all figures. */
	readonly light: SharedLight;
	readonly painter: Painter;
}

/**
 * Builds a figure in `place`, above its caption. Resolves when everything for the first picture is there; rejects with an
 * Error whose message is for the reader.
 */
export type Mount = (place: HTMLElement, lesson: Lesson) => Promise<void>;
