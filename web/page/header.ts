/** Header of all pages: links to the other pages and languages. */

import { addressIn, LANGUAGES, type Language } from './language.ts';

const PAGES = {
	demo: { file: './', en: 'Demo', zh: '演示' },
	learn: { file: './learn.html', en: 'Learn', zh: '学习' },
	bench: { file: './bench.html', en: 'Bench', zh: '测速' },
	embed: { file: './embed.html', en: 'Embed', zh: '嵌入' },
	docs: { file: './docs/', en: 'Docs', zh: '文档' },
} as const;

export type PageName = keyof typeof PAGES;

const SKIP = { en: 'Skip to the content', zh: '跳到正文' } as const;
const LABEL = { en: 'Pages', zh: '页面' } as const;

function link(text: string, href: string, className = ''): HTMLAnchorElement {
	const made = document.createElement('a');
	made.textContent = text;
	made.href = href;
	if (className) made.className = className;
	return made;
}

/** Puts a link past header and contents in front of them, seen while it has the focus. */
function addSkipLink(language: Language): void {
	const main = document.querySelector('main');
	if (!main) return;
	main.id ||= 'content';
	document.body.prepend(link(SKIP[language], `#${main.id}`, 'skip'));
}

/**
 * Fills the page's `<nav class="site">`. A language in the address is kept from page to page.
 */
export function fillHeader(nav: HTMLElement, here: PageName, language: Language): void {
	const asked = new URLSearchParams(location.search).has('lang') ? `?lang=${language}` : '';
	nav.setAttribute('aria-label', LABEL[language]);
	const home = link('furbake', `./${asked}`, 'home');
	const icon = document.createElement('img');
	icon.src = './icon.svg';
	icon.alt = '';
	home.prepend(icon);
	const links = Object.entries(PAGES).map(([name, page]) => {
		const made = link(page[language], `${page.file}${asked}`);
		if (name === here) made.setAttribute('aria-current', 'page');
		return made;
	});
	const other: Language = language === 'en' ? 'zh' : 'en';
	const { name, tag } = LANGUAGES[other];
	const change = link(name, addressIn(other, location.href), 'language');
	change.lang = change.hreflang = tag;
	// Read on click: the address changes with the view.
	change.addEventListener('click', () => {
		change.href = addressIn(other, location.href);
	});
	nav.replaceChildren(home, ...links, change);
	// The demo's first control comes right after its few links.
	if (here !== 'demo') addSkipLink(language);
}
