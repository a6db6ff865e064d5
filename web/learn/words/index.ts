/** What the lesson's figures say; the lesson itself is in `text/`. */

import type { Language } from '../../page/language.ts';
import { en } from './en.ts';
import { zh } from './zh.ts';

export type Words = typeof en;

export const WORDS: Record<Language, Words> = { en, zh };
