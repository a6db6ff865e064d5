/** The page's words in the visitor's language. */

import { type Language, languageOf } from '../../page/language.ts';
import { en, type Words } from './en.ts';
import { zh } from './zh.ts';

export type { Words };

export const language: Language = languageOf(location.search, navigator.languages);

export const words: Words = { en, zh }[language];
