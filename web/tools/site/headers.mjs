/**
 * Headers of the site, from `public/_headers` in the format of Netlify and Cloudflare Pages. Local servers of the built site
 * send them, and every built page contains the policy, for hosts that send none.
 */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from '../process.mjs';

/**
 * @typedef {object} Rule
 * @property {RegExp} path addresses below the site's root
 * @property {[name: string, value: string][]} headers
 */

/** File that is copied to dist/. */
export const headersFile = join(root, 'public', '_headers');

/** Directives that a page cannot set for itself. */
const NOT_IN_PAGES = /^(frame-ancestors|report-uri|report-to|sandbox)\b/;

/** Default of both hosts: always revalidate, by a 304. */
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
 * @returns {Record<string, string>} headers by name; values of several rules are joined by commas, as hosts do
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
