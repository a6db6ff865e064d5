/**
 * Language of a page, English or Chinese: by the address, else by the browser's preference.
 *
 * Words of a page are one object per language, of one type, so that the compiler finds missing ones. Two languages without
 * plurals need no package.
 */

export type Language = 'en' | 'zh';

/** Own name and `lang` tag of each language. */
export const LANGUAGES: Record<Language, { name: string; tag: string }> = {
	en: { name: 'English', tag: 'en' },
	zh: { name: '中文', tag: 'zh-Hans' },
};

export function isLanguage(name: string): name is Language {
	return Object.hasOwn(LANGUAGES, name);
}

/**
 * @param search the address's query: `lang=en` or `lang=zh` decides
 * @param preferred language tags by preference
 */
export function languageOf(search: string, preferred: readonly string[]): Language {
	const asked = new URLSearchParams(search).get('lang');
	if (asked && isLanguage(asked)) return asked;
	return preferred.map((tag) => tag.toLowerCase().split('-')[0] ?? '').find(isLanguage) ?? 'en';
}

/** Address in another language. */
export function addressIn(language: Language, href: string): string {
	const url = new URL(href);
	// By hand: other parameters keep their spelling.
	const others = url.search.slice(1).split('&');
	const kept = others.filter((part) => part !== '' && !/^lang(=|$)/.test(part));
	url.search = [...kept, `lang=${language}`].join('&');
	return url.href;
}

/**
 * Fills elements with words: `data-text="key"` as text, `data-label="key"` as aria-label, `data-tip="key"` as
 * title. The page's own title and description are the keys `title` and `description`.
 */
export function fillIn(words: Readonly<Record<string, unknown>>, language: Language): void {
	const root = document.documentElement;
	root.lang = LANGUAGES[language].tag;
	document.title = String(words.title);
	document.querySelector('meta[name="description"]')?.setAttribute('content', String(words.description));
	for (const found of root.querySelectorAll<HTMLElement>('[data-text], [data-label], [data-tip]')) {
		const { text, label, tip } = found.dataset;
		if (text) found.textContent = String(words[text]);
		if (label) found.setAttribute('aria-label', String(words[label]));
		if (tip) found.title = String(words[tip]);
	}
}
