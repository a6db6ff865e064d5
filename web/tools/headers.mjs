/**
 * The site's headers: `public/_headers`, in the form that Netlify and Cloudflare Pages read, is their one source. What serves
 * the built site sends them, and every built page holds the policy itself, for hosts that send none.
 */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './process.mjs';

/**
 * @typedef {object} Rule
 * @property {RegExp} path which addresses below the site's root it is for
 * @property {[name: string, value: string][]} headers
 */

/** Where dist/ is made from it. */
export const headersFile = join(root, 'public', '_headers');

/** Directives that a page cannot set for itself. */
const NOT_IN_PAGES = /^(frame-ancestors|report-uri|report-to|sandbox)\b/;

/** What both hosts send where no rule says otherwise: always ask, get a 304. */
const CACHE = 'public, max-age=0, must-revalidate';

/** @param {string} pattern `*` stands for anything, `:name` for anything without a slash; @returns {RegExp} */
function matcher(pattern) {
	const source = pattern
		.replace(/[.+?^${}()|[\]\\]/g, '\\$&')
		.replace(/\*/g, '.*')
		.replace(/:\w+/g, '[^/]+');
	return new RegExp(`^${source}$`);
}

/**
 * @param {string} text of a `_headers` file: lines of paths, and below each the headers, set in
 * @returns {Rule[]}
 */
export function parseHeaders(text) {
	/** @type {Rule[]} */
	const rules = [];
	for (const [i, line] of text.split(/\r?\n/).entries()) {
		const words = line.trim();
		if (words === '' || words.startsWith('#')) continue;
		const expected = (/** @type {string} */ what) =>
			new Error(`_headers: line ${i + 1}: got ${words}, expected ${what}`);
		if (!/^\s/.test(line)) {
			if (!words.startsWith('/')) throw expected('a path that begins with /');
			rules.push({ path: matcher(words), headers: [] });
			continue;
		}
		const [, name = '', value = ''] = /^([\w-]+):\s*(.+)$/.exec(words) ?? [];
		const rule = rules.at(-1);
		if (!name || !rule) throw expected(rule ? 'NAME: VALUE' : 'a path before it');
		rule.headers.push([name, value]);
	}
	return rules;
}

/**
 * @param {Rule[]} rules
 * @param {string} path below the site's root, begins with a slash
 * @returns {Record<string, string>} headers by name; of several rules for one header all values, with commas, as hosts do
 */
export function headersFor(rules, path) {
	/** @type {Record<string, string>} */
	const found = {};
	for (const rule of rules) {
		if (!rule.path.test(path)) continue;
		for (const [name, value] of rule.headers) found[name] = name in found ? `${found[name]}, ${value}` : value;
	}
	return { 'Cache-Control': CACHE, ...found };
}

/** @returns {Rule[]} the rules of this site */
export function siteRules() {
	return parseHeaders(readFileSync(headersFile, 'utf8'));
}

/** @param {Rule[]} rules; @returns {string} the content security policy of all pages, as a page can hold it */
export function policyInPage(rules) {
	const policy = headersFor(rules, '/index.html')['Content-Security-Policy'] ?? '';
	return policy
		.split(/;\s*/)
		.filter((directive) => directive && !NOT_IN_PAGES.test(directive))
		.join('; ');
}
