/**
 * Texts of the lesson: Markdown with KaTeX equations becomes a module of HTML at build time, so that browsers need neither.
 */
import { tex } from '@mdit/plugin-tex';
import katex from 'katex';
import markdownIt from 'markdown-it';

/** LaTeX macros for the paper's symbols. */
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
 * Plugin for `import html from '../text/en.md'`; keeps the one format of KaTeX's fonts that every browser with WebGL2 reads.
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
