/** The page's words in the visitor's language. */

import { type Language, languageOf } from '../../page/language.ts';
import { en, type Words } from './en.ts';

export type { Words };

export const language: Language = languageOf(location.search, navigator.languages);

/** Only English comes with the page. */
export const words: Words = language === 'zh' ? (await import('./zh.ts')).zh : en;
