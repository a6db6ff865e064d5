import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { CONTENTS, contents, guide, siteLink } from '../../web/tools/site/guide.mjs';
import { headingsOf, isExternal, linksOf, parse, resolveLink } from '../../web/tools/site/markdown.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));
const read = (path: string) => readFileSync(join(root, path), 'utf8');
const docs = readdirSync(join(root, 'web/docs')).map((name) => `web/docs/${name}`);
const README = 'README.md';
const CONTRIBUTING = '.github/CONTRIBUTING.md';
const SOURCES = [
	...[README, CONTRIBUTING, 'CHANGELOG.md'],
	...['baker/furbake/pelt/README.md', 'baker/furbake/asset/schema/README.md'],
	...docs,
];

/** Relative links of a page, resolved in the repository. */
const targetsOf = (source: string) =>
	linksOf(parse(read(source)))
		.filter(({ href }) => !isExternal(href))
		.map(({ href }) => ({ href, ...resolveLink(source, href) }));

describe.each(SOURCES)('%s', (source) => {
	it('has only relative links and anchors that resolve', () => {
		const broken = targetsOf(source).filter(({ path, hash }) => {
			if (!existsSync(join(root, path))) return true;
			return hash !== '' && !headingsOf(parse(read(path))).some(({ id }) => id === hash);
		});
		expect(broken.map(({ href }) => href)).toEqual([]);
	});

	it('has one title, and its sections in order', () => {
		const tags = headingsOf(parse(read(source))).map(({ tag }) => tag);
		expect(tags.filter((tag) => tag === 'h1')).toEqual(['h1']);
		expect(tags[0]).toBe('h1');
		for (const [i, tag] of tags.entries())
			expect(Number(tag[1])).toBeLessThanOrEqual(Number(tags[i - 1]?.[1] ?? 0) + 1);
	});
});

describe('README', () => {
	it('has at most 1500 words, tables and code included', () => {
		expect(read(README).split(/\s+/).filter(Boolean).length).toBeLessThanOrEqual(1500);
	});

	it('leads to every page of the docs in one click', () => {
		const linked = new Set(targetsOf(README).map(({ path }) => path));
		const missing = contents().flatMap(({ pages }) => pages.filter(({ path }) => !linked.has(path)));
		expect(missing.map(({ path }) => path)).toEqual([]);
	});
});

describe('CONTRIBUTING', () => {
	it('has every npm script', () => {
		const { scripts } = JSON.parse(read('package.json'));
		const [, table = ''] = /<!-- scripts -->([\s\S]*)<!-- \/scripts -->/.exec(read(CONTRIBUTING)) ?? [];
		const named = [...table.matchAll(/`npm (?:run )?([a-z]+)/g)]
			.map(([, name]) => name)
			.filter((name) => name !== 'pack');
		expect(named.sort()).toEqual(Object.keys(scripts).sort());
	});
});

describe('the docs on the site', () => {
	const files = guide({ reference: true });
	const pages = [...files].filter(([name]) => name.endsWith('.html'));

	it('have every page of web/docs', () => {
		const listed = contents().flatMap(({ pages }) => pages.map(({ path }) => path));
		expect([...listed].sort()).toEqual(expect.arrayContaining(docs.filter((path) => path !== CONTENTS)));
		expect(new Set(listed).size).toBe(listed.length);
		expect(pages).toHaveLength(listed.length + 1);
	});

	it.each(pages)('%s links to files and anchors that are there', (name, html) => {
		const links = [...html.matchAll(/ (?:href|src)="([^"]*)"/g)].map(([, link]) => `${link}`);
		const broken = links.filter((link) => {
			if (isExternal(link) || /^(\.\/|\.\.\/|reference\/)$/.test(link)) return false;
			const [path = '', hash] = link.split('#');
			if (path.startsWith('../'))
				return !['public', 'web'].some((folder) => existsSync(join(root, folder, path.slice(3))));
			const target = files.get(path || name);
			return target === undefined || (hash !== undefined && !target.includes(` id="${decodeURI(hash)}"`));
		});
		expect(broken).toEqual([]);
	});

	it.each(pages)('%s needs no script and no style of its own', (_, html) => {
		expect(html).not.toMatch(/<script|<style|<[^>]*\s(style|on\w+)=/);
		const policy = html.indexOf('Content-Security-Policy');
		expect(policy).toBeGreaterThan(0);
		expect(html.indexOf('<link')).toBeGreaterThan(policy);
		expect(html.match(/<h1/g)).toHaveLength(1);
	});

	it('name files that the site does not have without a link', () => {
		const page = files.get('library.html') ?? '';
		expect(page).toContain('<a href="../example.html"><code>example.html</code></a> and its script are a whole page');
	});
});

describe('siteLink', () => {
	const pages = new Set([CONTENTS, 'web/docs/a.md', 'CHANGELOG.md']);

	it.each([
		['https://three.js/', 'https://three.js/'],
		['#here', '#here'],
		['a.md#there', 'a.html#there'],
		['README.md', 'index.html'],
		['../../CHANGELOG.md', 'changelog.html'],
		['../../public/demo.jpg', '../demo.jpg'],
		['../learn.html', '../learn.html'],
		['../../public/_headers', undefined],
		['../example/main.ts', undefined],
		['b.md', undefined],
	])('%s is %s', (href, expected) => {
		expect(siteLink(join(dirname(CONTENTS), 'a.md'), href, pages)).toBe(expected);
	});
});
