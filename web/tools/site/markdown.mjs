/** Markdown as GitHub reads it: headings with their anchors, links with their targets in the repository. */
import { posix } from 'node:path';
import GithubSlugger from 'github-slugger';
import markdownIt from 'markdown-it';

/** @import { Token } from 'markdown-it' */

/** Comments in the sources are HTML. */
export const markdown = markdownIt({ html: true });

/** Plain text of a heading or a link. @param {Token[] | null} tokens */
const textOf = (tokens) => (tokens ?? []).map(({ content }) => content).join('');

/**
 * Tokens of a page. Headings have the `id` that GitHub gives them.
 *
 * @param {string} source
 */
export function parse(source) {
	const slugger = new GithubSlugger();
	const tokens = markdown.parse(source, {});
	for (const [i, token] of tokens.entries())
		if (token.type === 'heading_open') token.attrSet('id', slugger.slug(textOf(tokens[i + 1].children)));
	return tokens;
}

/** @param {Token[]} tokens; @returns {{ tag: string, id: string, title: string }[]} `tag`: h1 to h6 */
export function headingsOf(tokens) {
	return tokens.flatMap((token, i) =>
		token.type === 'heading_open'
			? [{ tag: token.tag, id: `${token.attrGet('id')}`, title: textOf(tokens[i + 1].children) }]
			: [],
	);
}

/** @param {Token[]} tokens; @returns {{ href: string, text: string }[]} targets of links, sources of pictures */
export function linksOf(tokens) {
	return tokens.flatMap(({ children }) =>
		(children ?? []).flatMap((token, i, line) => {
			if (token.type === 'image') return [{ href: `${token.attrGet('src')}`, text: token.content }];
			if (token.type !== 'link_open') return [];
			const end = line.findIndex(({ type }, j) => j > i && type === 'link_close');
			return [{ href: `${token.attrGet('href')}`, text: textOf(line.slice(i + 1, end)) }];
		}),
	);
}

/** @param {string} href */
export const isExternal = (href) => /^[a-z]+:/.test(href);

/**
 * @param {string} from path of the page in the repository
 * @param {string} href relative
 * @returns {{ path: string, hash: string }} path in the repository, and the anchor without its #
 */
export function resolveLink(from, href) {
	const [path = '', hash = ''] = decodeURI(href).split('#');
	return { path: path ? posix.join(posix.dirname(from), path) : from, hash };
}
