/** What every step of the lesson is given, and what it has to be. */

import type { Language } from '../page/language.ts';
import type { SharedLight } from './light.ts';
import type { Painter } from './painter.ts';
import type { Words } from './words/index.ts';

export interface Lesson {
	readonly language: Language;
	readonly words: Words;
	/** Nothing moves by itself: reduced motion is asked for, or the address says `still=1`. */
	readonly calm: boolean;
	/** The same in all figures. */
	readonly light: SharedLight;
	readonly painter: Painter;
}

/**
 * Builds a figure: puts what belongs to it into `place`, above its caption. The promise is fulfilled when all is there
 * that the first picture needs; rejected with an Error whose words are for the reader.
 */
export type Mount = (place: HTMLElement, lesson: Lesson) => Promise<void>;
