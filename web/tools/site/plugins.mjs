/** Plugins of vite: policy and headers of the hosted site, shaders, fonts, and metadata for shared links. */
import { readFile } from 'node:fs/promises';
import { posix } from 'node:path';
import { Failure } from '../process.mjs';
import { headersFor, policyInPage, siteRules } from './headers.mjs';

/** @import { Connect, HtmlTagDescriptor, Plugin } from 'vite' */

/**
 * Serves dist/ with the headers of `_headers`, and puts the content security policy into built pages, for hosts that send no
 * headers. Not in development: vite adds its own scripts to pages.
 *
 * @returns {Plugin}
 */
export function headersPlugin() {
	return {
		name: 'furbake-headers',
		configurePreviewServer({ middlewares }) {
			const rules = siteRules();
			/** @type {Connect.NextHandleFunction} */
			const send = (request, response, next) => {
				const { pathname } = new URL(request.url ?? '/', 'http://localhost');
				for (const [name, value] of Object.entries(headersFor(rules, pathname))) response.setHeader(name, value);
				next();
			};
			middlewares.use(send);
		},
		transformIndexHtml: {
			order: 'post',
			handler(html, { server }) {
				if (server) return html;
				const policy = `<meta http-equiv="Content-Security-Policy" content="${policyInPage(siteRules())}" />`;
				// Before everything that it applies to, after the encoding, which has to be in the first 1024 bytes.
				return html.replace(/<meta charset="utf-8" ?\/?>/, `$&\n    ${policy}`);
			},
		},
	};
}

/**
 * @param {string} source
 * @returns {string} the shader without comments and needless spaces, directives on their own lines
 */
export function bareShader(source) {
	const lines = source
		.replace(/\/\*[\s\S]*?\*\/|\/\/.*$/gm, '')
		.split('\n')
		.map((line) => line.trim())
		.filter((line) => line !== '')
		.map((line) =>
			line.startsWith('#') ? line : line.replace(/ ?([=,;(){}?:<>*/&|]) ?/g, '$1').replace(/ ([+-]) (?![+-])/g, '$1'),
		);
	// Compilers warn of a directive without a line's end.
	if (lines.at(-1)?.startsWith('#')) lines.push('');
	return lines.reduce((text, line, i) => {
		const before = lines[i - 1] ?? '';
		const joined = i === 0 || (/[;{}]$/.test(before) && !before.startsWith('#') && !line.startsWith('#'));
		return `${text}${joined ? '' : '\n'}${line}`;
	}, '');
}

/**
 * @param {string} source of a JSON schema
 * @returns {string} the schema without words for readers
 */
export function bareSchema(source) {
	/** @param {string} key; @param {unknown} value */
	const keep = (key, value) =>
		(key === 'description' || key === 'title') && typeof value === 'string' ? undefined : value;
	return JSON.stringify(JSON.parse(source, keep));
}

/** Shaders in three's module: quoted texts of several lines, or of one directive. */
const THREE_SHADER = /^(?:var|const) [\w$]+ = ("(?:[^"\\]|\\.)*\\n(?:[^"\\]|\\.)*"|"#\w+ [^"\\]*");$/gm;

/**
 * @param {string} code of three.module.js
 * @returns {string} the module, its quoted shaders bare: 1.8 kB of gzip less
 */
export function bareThree(code) {
	return code.replace(THREE_SHADER, (line, text) =>
		line.replace(text, () => JSON.stringify(bareShader(JSON.parse(text)))),
	);
}

/**
 * Strips comments and needless spaces from shaders, two fifths of their bytes, and descriptions from schemas.
 *
 * @returns {Plugin}
 */
export function barePlugin() {
	return {
		name: 'furbake-bare',
		apply: 'build',
		enforce: 'pre',
		async load(id) {
			const [shader, schema] = [id.endsWith('.glsl?raw'), id.endsWith('.schema.json')];
			if (!shader && !schema) return undefined;
			const source = await readFile(id.replace(/\?raw$/, ''), 'utf8');
			const code = shader ? JSON.stringify(bareShader(source)) : bareSchema(source);
			return { code: `export default ${code};`, moduleType: 'js' };
		},
		transform(code, id) {
			if (!id.endsWith('/three/build/three.module.js')) return undefined;
			const bare = bareThree(code);
			if (bare === code) throw new Failure(`${id}: got no quoted shader, expected those of three`);
			return { code: bare, map: null };
		},
	};
}

/**
 * Puts modules of the library that are fetched on demand into the file that asks for them: our pages show fur that has all
 * of it, and as a file of its own, or wrapped as one, each costs a request or a kilobyte.
 *
 * @param {RegExp} [apart] modules that are left as they are
 * @returns {Plugin}
 */
export function wholePlugin(apart) {
	return {
		name: 'furbake-whole',
		apply: 'build',
		enforce: 'pre',
		transform(code, id) {
			if (!/\/web\/fur\/.*\.ts$/.test(id)) return undefined;
			/** @type {string[]} */
			const paths = [];
			const fetched = /(?<!typeof )\bimport\('(\.[^']+)'\)/g;
			const whole = code.replace(fetched, (text, path) =>
				apart?.test(path) ? text : `Promise.resolve(whole${paths.push(path) - 1})`,
			);
			const imports = paths.map((path, i) => `import * as whole${i} from '${path}';`);
			return imports.length ? { code: [...imports, whole].join('\n'), map: null } : undefined;
		},
	};
}

/**
 * Moves fonts in packages' style sheets to files: the policy allows none in `data:` addresses.
 *
 * @returns {Plugin}
 */
export function fontsPlugin() {
	return {
		name: 'furbake-fonts',
		apply: 'build',
		generateBundle(_, bundle) {
			for (const file of Object.values(bundle)) {
				if (file.type !== 'asset' || !file.fileName.endsWith('.css')) continue;
				const folder = posix.dirname(file.fileName);
				const font = /url\(["']?data:(?:application|font)\/[\w-]*woff2[^,"')]*;base64,([^"')]*)["']?\)/g;
				file.source = `${file.source}`.replace(font, (_, base64) => {
					const id = this.emitFile({ type: 'asset', name: 'font.woff2', source: Buffer.from(base64, 'base64') });
					return `url(./${posix.relative(folder, this.getFileName(id))})`;
				});
			}
		},
	};
}

/**
 * @param {string | undefined} site address of the hosted dist/, as in SITE_URL
 * @returns {URL | undefined} with a slash at its end
 */
export function siteAddress(site) {
	if (!site) return undefined;
	const address = URL.canParse(site) ? new URL(site) : undefined;
	if (!address || !/^https?:$/.test(address.protocol))
		throw new Failure(`SITE_URL: got ${site}, expected the address of the site, as in https://example.org/furbake/`);
	address.search = address.hash = '';
	if (!address.pathname.endsWith('/')) address.pathname += '/';
	return address;
}

const PICTURE = { file: 'og.jpg', width: 1200, height: 630, words: 'A furry bunny in warm light from the side' };

/** @param {string} name; @param {string} content; @returns {HtmlTagDescriptor} */
const open = (name, content) => ({ tag: 'meta', attrs: { property: name, content }, injectTo: 'head' });

/** @param {string} rel; @param {Record<string, string>} attrs; @returns {HtmlTagDescriptor} */
const link = (rel, attrs) => ({ tag: 'link', attrs: { rel, ...attrs }, injectTo: 'head' });

/** Text with HTML entities decoded. @param {string | undefined} text */
const plain = (text = '') => text.replace(/&middot;/g, '·').replace(/&amp;/g, '&');

/**
 * Adds metadata to every page: Open Graph for shared links, the manifest, and, if the site's address is known, addresses of
 * the page and its languages. Addresses of pictures have to be absolute there.
 *
 * @param {string | undefined} site SITE_URL
 * @returns {Plugin}
 */
export function sharePlugin(site) {
	const address = siteAddress(site);
	/** @param {string} path */
	const absolute = (path) => (address ? new URL(path, address).href : `./${path}`);
	return {
		name: 'furbake-share',
		transformIndexHtml(html, { path }) {
			const file = path.replace(/^\//, '');
			// A host shows this page at any address, where relative paths would break.
			if (file === '404.html')
				return address ? [{ tag: 'base', attrs: { href: address.pathname }, injectTo: 'head-prepend' }] : [];
			const title = plain(/<title>([^<]*)</.exec(html)?.[1]);
			const description = plain(/<meta\s+name="description"\s+content="([^"]*)"/.exec(html)?.[1]);
			const page = file === 'index.html' ? '' : file;
			const own = address && new URL(page, address);
			return [
				open('og:type', 'website'),
				open('og:site_name', 'furbake'),
				open('og:title', title),
				open('og:description', description),
				open('og:image', absolute(PICTURE.file)),
				open('og:image:width', `${PICTURE.width}`),
				open('og:image:height', `${PICTURE.height}`),
				open('og:image:alt', PICTURE.words),
				{ tag: 'meta', attrs: { name: 'twitter:card', content: 'summary_large_image' }, injectTo: 'head' },
				link('manifest', { href: './manifest.webmanifest' }),
				link('apple-touch-icon', { href: './home.png' }),
				...(own
					? [
							open('og:url', own.href),
							link('canonical', { href: own.href }),
							...['en', 'zh-Hans'].map((tag) =>
								link('alternate', { hreflang: tag, href: `${own.href}?lang=${tag.slice(0, 2)}` }),
							),
							link('alternate', { hreflang: 'x-default', href: own.href }),
						]
					: []),
			];
		},
	};
}
