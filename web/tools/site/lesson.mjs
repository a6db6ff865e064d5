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

// Browsers break a line between an equation and the sign after it, which must not begin one.
markdown.core.ruler.push('closing', ({ tokens, Token }) => {
	for (const { children } of tokens) {
		for (let i = (children?.length ?? 0) - 2; children && i >= 0; i--) {
			const [equation, after] = [children[i], children[i + 1]];
			const sign = after?.type === 'text' && /^[,.;:)!?\u2019，。、；：）！？]+/.exec(after.content)?.[0];
			if (equation?.type !== 'math_inline' || !after || !sign) continue;
			const [open, close] = ['<span class="unbroken">', `${sign}</span>`].map((content) =>
				Object.assign(new Token('html_inline', '', 0), { content }),
			);
			after.content = after.content.slice(sign.length);
			children.splice(i, 1, open, equation, close);
		}
	}
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
