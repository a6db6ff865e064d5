/**
 * The lesson's texts: Markdown becomes a module of HTML when the page is built, its equations set by KaTeX, so that no
 * browser runs a program for either.
 */
import { tex } from '@mdit/plugin-tex';
import katex from 'katex';
import markdownIt from 'markdown-it';

/** What all texts may use beyond LaTeX: the paper's own symbols. */
const macros = {
	'\\lu': 'l_u',
	'\\lv': 'l_v',
	'\\lvec': '\\boldsymbol{l}',
	'\\dB': '\\,\\text{dB}',
};

const markdown = markdownIt({ html: true, typographer: true }).use(tex, {
	render: (source, displayMode) =>
		katex.renderToString(source, { displayMode, macros: { ...macros }, strict: 'error' }),
});

/** @param {string} source Markdown with `$…$` and `$$…$$`; @returns {string} HTML */
export function typeset(source) {
	return markdown.render(source);
}

/**
 * `import html from './text/en.md'`; and of KaTeX's fonts the one format that every browser with WebGL2 reads.
 *
 * @returns {import('vite').Plugin}
 */
export function lesson() {
	return {
		name: 'furbake:lesson',
		enforce: 'pre',
		transform(source, id) {
			const [path = ''] = id.split('?');
			if (path.endsWith('.md'))
				return { code: `export default ${JSON.stringify(typeset(source))};`, map: null, moduleType: 'js' };
			if (/[\\/]katex[\\/]dist[\\/][\w.]+\.css$/.test(path))
				return { code: source.replace(/,\s*url\([^)]+\.(woff|ttf)\)\s*format\([^)]*\)/g, ''), map: null };
			return undefined;
		},
	};
}
