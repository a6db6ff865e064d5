import { describe, expect, it } from 'vitest';
import { headersFor, parseHeaders, policyInPage, siteRules } from '../../../web/tools/site/headers.mjs';

describe('parseHeaders', () => {
	const rules = parseHeaders(
		'# all\n/*\n  X-One: 1\n  # why\n  X-Two: a: b, c\r\n\n/assets/*\n\tX-One: 2\n/:page.html\n  X-Page: yes\n',
	);

	it('gives a path the headers of every rule that it falls under', () => {
		expect(headersFor(rules, '/')).toMatchObject({ 'X-One': '1', 'X-Two': 'a: b, c' });
		expect(headersFor(rules, '/learn.html')).toMatchObject({ 'X-One': '1', 'X-Page': 'yes' });
		expect(headersFor(rules, '/a/learn.html')).not.toHaveProperty('X-Page');
		expect(headersFor(rules, '/learnxhtml')).not.toHaveProperty('X-Page');
	});

	it('joins what several rules say of one header, as hosts do', () => {
		expect(headersFor(rules, '/assets/a/b.js')['X-One']).toBe('1, 2');
	});

	it.each([
		['  X-One: 1', 'line 1: got X-One: 1, expected a path before it'],
		['/*\n  X-One', 'line 2: got X-One, expected NAME: VALUE'],
		['# a\nassets', 'line 2: got assets, expected a path that begins with /'],
	])('refuses %j', (text, message) => {
		expect(() => parseHeaders(text)).toThrow(`_headers: ${message}`);
	});
});

describe("the site's own rules", () => {
	const rules = siteRules();

	it('keep hashed files for good, and ask for all else again', () => {
		expect(headersFor(rules, '/assets/index-DbECSHKS.js')['Cache-Control']).toBe('public, max-age=31536000, immutable');
		for (const path of ['/', '/learn.html', '/models/bunny/model.bin', '/lesson/x.json', '/og.jpg'])
			expect(headersFor(rules, path)['Cache-Control'], path).toBe('public, max-age=0, must-revalidate');
	});

	it('allow what the page has brought along and nothing else', () => {
		const headers = headersFor(rules, '/');
		const policy = new Map(
			`${headers['Content-Security-Policy']}`.split('; ').map((directive) => {
				const [name = '', ...sources] = directive.split(' ');
				return [name, sources];
			}),
		);
		expect(policy.get('default-src')).toEqual(["'self'"]);
		expect(policy.get('script-src')).toEqual(["'self'", "'wasm-unsafe-eval'"]);
		expect(policy.get('style-src')).toEqual(["'self'"]);
		expect(policy.get('object-src')).toEqual(["'none'"]);
		for (const name of ['base-uri', 'form-action', 'frame-ancestors']) expect(policy.get(name)).toEqual(["'self'"]);
		for (const sources of policy.values()) expect(sources.join(' ')).not.toMatch(/https?:|\*|(?<!wasm-)unsafe-eval/);
		expect(headers['X-Content-Type-Options']).toBe('nosniff');
		expect(headers['Referrer-Policy']).toBe('same-origin');
	});

	it('go into pages without what a page cannot set for itself', () => {
		const policy = policyInPage(rules);
		expect(policy).toContain("default-src 'self'; ");
		expect(policy).not.toContain('frame-ancestors');
		expect(policy).not.toContain('"');
	});
});
