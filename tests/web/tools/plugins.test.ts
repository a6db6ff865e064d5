import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import {
	barePlugin,
	bareSchema,
	bareShader,
	bareThree,
	fontsPlugin,
	sharePlugin,
	siteAddress,
} from '../../../web/tools/site/plugins.mjs';

const page = `<html><head><title>furbake · learn</title>
	<meta name="description" content="Strands &amp; slices." /></head></html>`;

/** What the plugin puts into a page: content or address by name. */
function tags(site: string | undefined, path: string): Record<string, string> {
	const { transformIndexHtml } = sharePlugin(site) as unknown as {
		transformIndexHtml: (html: string, context: { path: string }) => { attrs: Record<string, string> }[];
	};
	return Object.fromEntries(
		transformIndexHtml(page, { path }).map(({ attrs }) => [
			[attrs.property ?? attrs.name ?? attrs.rel ?? 'base', attrs.hreflang].filter(Boolean).join(' '),
			attrs.content ?? attrs.href ?? '',
		]),
	);
}

describe('siteAddress', () => {
	it('ends in a slash, without query', () => {
		expect(siteAddress('https://example.org/furbake?a#b')?.href).toBe('https://example.org/furbake/');
		expect(siteAddress(undefined)).toBeUndefined();
		expect(siteAddress('')).toBeUndefined();
	});

	it.each(['example.org', 'ftp://example.org/', '/furbake/'])('refuses %s', (site) => {
		expect(() => siteAddress(site)).toThrow(`SITE_URL: got ${site}, expected the address of the site`);
	});
});

describe('bareSchema', () => {
	it('drops words for readers, no property of that name', () => {
		const properties = { title: { type: 'string', description: 'A name.' } };
		const bare = bareSchema(JSON.stringify({ title: 'A thing', properties, required: ['title'] }));
		expect(JSON.parse(bare)).toEqual({ properties: { title: { type: 'string' } }, required: ['title'] });
	});
});

describe('bareShader', () => {
	it('leaves directives on lines of their own, and no words', () => {
		const source =
			'// what\n\n#define A 2.0 // why\n\tfloat a = A / 2.0; /* b\n c */\n\n\n\treturn a * a;\n}\n#endif\nint b;\n';
		expect(bareShader(source)).toBe('#define A 2.0\nfloat a=A/2.0;return a*a;}\n#endif\nint b;');
	});

	it('keeps signs apart, and what goes on on the next line', () => {
		expect(bareShader('a = b - -c + d;\nvec2 e = vec2(1.0,\n\t-1.0);')).toBe('a=b - -c+d;vec2 e=vec2(1.0,\n-1.0);');
	});

	it('ends the line of a last directive', () => {
		expect(bareShader('#ifdef A\nint a;\n#endif // A\n')).toBe('#ifdef A\nint a;\n#endif\n');
	});
});

describe('bareThree', () => {
	const source = readFileSync(new URL('../../../node_modules/three/build/three.module.js', import.meta.url), 'utf8');
	const { transform } = barePlugin() as unknown as { transform: (code: string, id: string) => { code: string } };
	const bare = transform(source, '/node_modules/three/build/three.module.js').code;

	it('leaves no comment and no indent in the shaders of three', () => {
		const shader = /^(?:var|const) [\w$]+ = "[^"]*(?:\/\/|\\n\\t)/gm;
		expect(source.match(shader)?.length).toBeGreaterThan(60);
		expect(bare.match(shader)?.length ?? 0).toBe(0);
		expect(source.length - bare.length).toBeGreaterThan(20_000);
	});

	it('leaves the code around them, and words in one line, as they are', () => {
		const code = (text: string) => text.replace(/^(var|const) [\w$]+ = ".*";$/gm, '');
		expect(code(bare)).toBe(code(source));
		for (const text of ['// no shader', '#fff', 'a  =  b'])
			expect(bareThree(`const a = "${text}";\n`)).toBe(`const a = "${text}";\n`);
	});

	it('tells where three has its shaders elsewhere', () => {
		expect(() => transform('export {};\n', '/node_modules/three/build/three.module.js')).toThrow(
			'got no quoted shader',
		);
	});
});

describe('fontsPlugin', () => {
	it('makes files of fonts in style sheets, beside them, and of nothing else', () => {
		const { generateBundle } = fontsPlugin() as unknown as {
			generateBundle: (options: unknown, bundle: Record<string, unknown>) => void;
		};
		const sheet = {
			type: 'asset',
			fileName: 'assets/a.css',
			source: `a{src:url("data:application/font-woff2;charset=utf-8;base64,${btoa('font')}")format("woff2");background:url(data:image/png;base64,AAAA)}`,
		};
		const emitted: string[] = [];
		const context = {
			emitFile({ source }: { source: Buffer }) {
				emitted.push(source.toString());
				return 'id';
			},
			getFileName: () => 'assets/font-1.woff2',
		};
		generateBundle.call(context, {}, { sheet });
		expect(sheet.source).toBe('a{src:url(./font-1.woff2)format("woff2");background:url(data:image/png;base64,AAAA)}');
		expect(emitted).toEqual(['font']);
	});
});

describe('sharePlugin', () => {
	it("takes a shared link's words from the page", () => {
		const found = tags(undefined, '/learn.html');
		expect(found).toMatchObject({
			'og:title': 'furbake · learn',
			'og:description': 'Strands & slices.',
			'og:image': './og.jpg',
			'twitter:card': 'summary_large_image',
			manifest: './manifest.webmanifest',
			'apple-touch-icon': './home.png',
		});
		expect(found).not.toHaveProperty('canonical');
	});

	it('gives whole addresses where the site has one', () => {
		expect(tags('https://example.org/fur', '/learn.html')).toMatchObject({
			'og:image': 'https://example.org/fur/og.jpg',
			'og:url': 'https://example.org/fur/learn.html',
			canonical: 'https://example.org/fur/learn.html',
			'alternate zh-Hans': 'https://example.org/fur/learn.html?lang=zh',
			'alternate x-default': 'https://example.org/fur/learn.html',
		});
		expect(tags('https://example.org/fur', '/index.html').canonical).toBe('https://example.org/fur/');
	});

	it('lets the page of lost addresses find its files from anywhere', () => {
		expect(tags('https://example.org/fur', '/404.html')).toEqual({ base: '/fur/' });
		expect(tags(undefined, '/404.html')).toEqual({});
	});
});

describe('public/og.jpg', () => {
	it('is of the size that pages say, and light enough for those who show it', () => {
		const bytes = readFileSync(new URL('../../../public/og.jpg', import.meta.url));
		// The frame header of a baseline JPEG: length, precision, height, width.
		const frame = bytes.indexOf(Buffer.from([0xff, 0xc0]));
		expect([bytes.readUInt16BE(frame + 7), bytes.readUInt16BE(frame + 5)]).toEqual([1200, 630]);
		expect(bytes.length).toBeLessThan(150_000);
	});
});
