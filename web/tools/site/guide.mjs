/**
 * The docs as pages of the site: Markdown becomes HTML without a script. `web/docs/README.md` is the list of contents: each
 * Markdown file that it links to is a page.
 */
import { readFileSync } from 'node:fs';
import { join, posix } from 'node:path';
import { root } from '../process.mjs';
import { policyInPage, siteRules } from './headers.mjs';
import { headingsOf, isExternal, linksOf, markdown, parse, resolveLink } from './markdown.mjs';

/** @import { Connect, Plugin } from 'vite' */
/** @import { Token } from 'markdown-it' */

/**
 * @typedef {object} Page
 * @property {string} path of its Markdown, in the repository
 * @property {string} file on the site, in docs/
 * @property {string} title
 */

/** Path of the list of contents. */
export const CONTENTS = 'web/docs/README.md';

const SCHEMA = 'baker/furbake/asset/schema/FUR_ptm_shells.schema.json';
/** Page whose group has the library's reference, too. */
const LIBRARY = 'library.html';
const STYLES = ['web/page/tokens.css', 'web/page/docs.css'];

/** Files on the site of pages that stand elsewhere in the repository. */
const ELSEWHERE = new Map([
	[CONTENTS, 'index.html'],
	['baker/furbake/pelt/README.md', 'pelt.html'],
	['baker/furbake/asset/schema/README.md', 'FUR_ptm_shells.html'],
	['.github/CONTRIBUTING.md', 'contributing.html'],
]);

/** @param {string} path in the repository */
const read = (path) => readFileSync(join(root, path), 'utf8');

/** @param {string} path of a Markdown file */
const fileOf = (path) => ELSEWHERE.get(path) ?? posix.basename(path).toLowerCase().replace(/\.md$/, '.html');

const { escapeHtml } = markdown.utils;

/** @returns {{ title: string, pages: Page[] }[]} the list of contents by its headings */
export function contents() {
	/** @type {{ title: string, pages: Page[] }[]} */
	const groups = [];
	const tokens = parse(read(CONTENTS));
	for (const [i, token] of tokens.entries()) {
		if (token.type === 'heading_open' && token.tag === 'h2') groups.push({ title: tokens[i + 1].content, pages: [] });
		for (const { href, text } of linksOf([token])) {
			const { path } = resolveLink(CONTENTS, href);
			groups.at(-1)?.pages.push({ path, file: fileOf(path), title: text });
		}
	}
	return groups;
}

/**
 * @param {string} from path of the page in the repository
 * @param {string} href as on GitHub
 * @param {ReadonlySet<string>} paths of all pages
 * @returns {string | undefined} the same on the site; undefined where the site has no such file
 */
export function siteLink(from, href, paths) {
	if (isExternal(href) || href.startsWith('#')) return href;
	const { path, hash } = resolveLink(from, href);
	if (paths.has(path)) return fileOf(path) + (hash && `#${hash}`);
	if (path === SCHEMA) return posix.basename(SCHEMA);
	const served = /^public\/(?!_)(.*\.\w+)$/.exec(path) ?? /^web\/([\w-]+\.html)$/.exec(path);
	return served ? `../${served[1]}` : undefined;
}

/** Gives links and pictures their addresses on the site. @param {Token[]} line; @param {(href: string) => string | undefined} link */
function relink(line, link) {
	let gone = false;
	for (const token of line) {
		if (token.type === 'image') token.attrSet('src', link(`${token.attrGet('src')}`) ?? '');
		if (token.type === 'link_open') {
			const href = link(`${token.attrGet('href')}`);
			gone = href === undefined;
			if (href !== undefined) token.attrSet('href', href);
		}
		// Files that the site does not have are named all the same.
		if (gone && /^link_/.test(token.type)) Object.assign(token, { type: 'text', content: '' });
		else if (token.type === 'link_close') gone = false;
	}
}

/** Inline styles of aligned columns are against the policy. @param {Token} token */
function alignByClass(token) {
	const [, side] = /text-align:(\w+)/.exec(token.attrGet('style') ?? '') ?? [];
	if (side) token.attrs = [['class', side]];
}

markdown.renderer.rules.table_open = () => '<div class="wide" tabindex="0"><table>\n';
markdown.renderer.rules.table_close = () => '</table></div>\n';
const { fence } = markdown.renderer.rules;
markdown.renderer.rules.fence = (...parts) => `${fence?.(...parts)}`.replace(/^<pre/, '<pre tabindex="0"');

/** @param {Token[]} tokens; @returns {string} */
const htmlOf = (tokens) => markdown.renderer.render(tokens, markdown.options, {});

/** @param {[href: string, text: string, current?: 'page' | 'true'][]} links */
const listOf = (links) =>
	links
		.map(([href, text, current]) => {
			const mark = current ? ` aria-current="${current}"` : '';
			return `<a href="${href}"${mark}>${escapeHtml(text)}</a>`;
		})
		.join('\n');

/**
 * @param {Page} page
 * @param {{ groups: ReturnType<typeof contents>, paths: ReadonlySet<string>, reference: boolean }} site
 * @returns {string} HTML
 */
function render({ path, title }, { groups, paths, reference }) {
	const tokens = parse(read(path));
	for (const token of tokens) {
		alignByClass(token);
		if (token.children) relink(token.children, (href) => siteLink(path, href, paths));
	}
	// The list of sections stands below the title.
	const top = tokens.findIndex(({ type, tag }) => type === 'heading_close' && tag === 'h1') + 1;
	const sections = headingsOf(tokens).filter(({ tag }) => tag === 'h2');
	const inPage = listOf(sections.map(({ id, title }) => [`#${id}`, title]));
	const pages = groups.map(({ title, pages }) => {
		/** @type {Parameters<typeof listOf>[0]} */
		const links = pages.map((page) => [page.file, page.title, page.path === path ? 'page' : undefined]);
		if (reference && pages.some(({ file }) => file === LIBRARY)) links.push(['reference/', 'Reference']);
		return `<h2>${escapeHtml(title)}</h2>\n${listOf(links)}`;
	});
	return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8" />
<meta http-equiv="Content-Security-Policy" content="${policyInPage(siteRules())}" />
<meta name="viewport" content="width=device-width, initial-scale=1, viewport-fit=cover" />
<title>furbake · ${escapeHtml(title)}</title>
<meta name="theme-color" content="#222b34" media="(prefers-color-scheme: dark)" />
<meta name="theme-color" content="#f4f1ec" media="(prefers-color-scheme: light)" />
<link rel="icon" href="../icon.svg" />
<link rel="stylesheet" href="style.css" />
</head>
<body>
<a class="skip" href="#content">Skip to the content</a>
<header class="bar"><nav class="site" aria-label="Pages">
<a class="home" href="../"><img src="../icon.svg" alt="" />furbake</a>
${listOf([
	['../', 'Demo'],
	['../learn.html', 'Learn'],
	['../bench.html', 'Bench'],
	['../embed.html', 'Embed'],
	['./', 'Docs', path === CONTENTS ? 'page' : 'true'],
])}
</nav></header>
<div class="frame">
<main id="content">
${htmlOf(tokens.slice(0, top))}
${path !== CONTENTS && sections.length > 2 ? `<nav class="sections" aria-label="On this page">\n${inPage}\n</nav>` : ''}
${htmlOf(tokens.slice(top))}
</main>
<nav class="pages" aria-label="Documentation">
${pages.join('\n')}
</nav>
</div>
</body>
</html>
`;
}

/**
 * @param {{ reference: boolean }} site whether the library's reference is beside them
 * @returns {Map<string, string>} contents of all files in docs/ by their names
 */
export function guide({ reference }) {
	const groups = contents();
	const pages = [
		{ path: CONTENTS, file: 'index.html', title: 'Documentation' },
		...groups.flatMap(({ pages }) => pages),
	];
	const paths = new Set(pages.map(({ path }) => path));
	return new Map([
		...pages.map((page) => /** @type {[string, string]} */ ([page.file, render(page, { groups, paths, reference })])),
		['style.css', STYLES.map(read).join('\n')],
		[posix.basename(SCHEMA), read(SCHEMA)],
	]);
}

const TYPES = { '.html': 'text/html; charset=utf-8', '.css': 'text/css', '.json': 'application/json' };

/**
 * The docs in docs/, of the built site and while one develops.
 *
 * @returns {Plugin}
 */
export function guidePlugin() {
	return {
		name: 'furbake-guide',
		configureServer({ middlewares }) {
			/** @type {Connect.NextHandleFunction} */
			const serve = (request, response, next) => {
				const { pathname } = new URL(request.url ?? '/', 'http://localhost');
				const [, file] = /^\/docs\/([\w.-]*)$/.exec(pathname) ?? [];
				const text = file === undefined ? undefined : guide({ reference: false }).get(file || 'index.html');
				if (text === undefined) return next();
				const type = TYPES[/** @type {keyof typeof TYPES} */ (posix.extname(file || 'index.html'))];
				response.setHeader('Content-Type', type).end(text);
			};
			middlewares.use(serve);
		},
		generateBundle() {
			for (const [file, source] of guide({ reference: false }))
				this.emitFile({ type: 'asset', fileName: `docs/${file}`, source });
		},
	};
}
