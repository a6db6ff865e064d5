/** Words of the page, in either language. */

import type { Language } from '../../page/language.ts';
import { en, type Words } from './en.ts';
import { zh } from './zh.ts';

export const WORDS: Record<Language, Words> = { en, zh };
