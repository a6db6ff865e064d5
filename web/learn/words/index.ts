/** Words of the lesson's figures; the lesson itself is in `text/`. */

import type { Language } from '../../page/language.ts';
import { en, type Words } from './en.ts';
import { zh } from './zh.ts';

export type { Words } from './en.ts';

/** Words of the figures on sampling, fit, bytes and numbers per texel. */
export type MeasuredWords = Words['measured'];

export const WORDS: Record<Language, Words> = { en, zh };
