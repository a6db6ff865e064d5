/** Words of the lesson: names, terms, length, and figures that agree with what was measured. */

import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { Fit, polynomial, relitTexels } from '../../../web/learn/data/fit.ts';
import { decodeLayer, type LessonRecord } from '../../../web/learn/data/measurements.ts';
import { blockErrors } from '../../../web/learn/mean/blocks.ts';
import { WORDS } from '../../../web/learn/words/index.ts';
import { typeset } from '../../../web/tools/site/lesson.mjs';

const file = (path: string) => readFileSync(new URL(`../../../${path}`, import.meta.url));
const source = (language: string) => file(`web/learn/text/${language}.md`).toString();
const LANGUAGES = ['en', 'zh'] as const;
type Language = (typeof LANGUAGES)[number];

/** Terms and the name of each step that explains it. */
const TERMS: Record<Language, [term: RegExp, section: string][]> = {
	en: [
		[/polynomial texture maps?|PTM/i, 'intro'],
		[/extinction/i, 'slices'],
		[/texel/i, 'slices'],
		[/singular value|SVD/i, 'texel'],
		[/decibel|\bdB\b/i, 'bits'],
		[/fragment/i, 'numbers'],
		[/tangent frame/i, 'body'],
	],
	zh: [
		[/多项式纹理映射|PTM/, 'intro'],
		[/消光系数/, 'slices'],
		[/纹素/, 'slices'],
		[/奇异值分解|SVD/, 'texel'],
		[/分贝|dB/, 'bits'],
		[/片元/, 'numbers'],
		[/切线标架/, 'body'],
	],
};

/** Words, or Chinese characters, of each step before the lesson was built up for teachers, or when it was new. */
const BEFORE: Record<Language, Record<string, number>> = {
	en: {
		intro: 45,
		shells: 127,
		slices: 102,
		dome: 110,
		texel: 106,
		bits: 91,
		numbers: 92,
		body: 223,
		nap: 131,
		rivals: 99,
		paper: 96,
		swing: 184,
		pose: 120,
		wet: 140,
	},
	zh: {
		intro: 76,
		shells: 166,
		slices: 140,
		dome: 170,
		texel: 166,
		bits: 145,
		numbers: 172,
		body: 333,
		nap: 195,
		rivals: 149,
		paper: 132,
		swing: 273,
		pose: 190,
		wet: 216,
	},
};

/** Sections of the Markdown by name, the lines in front of the first as `intro`. */
function sections(language: Language): Map<string, string> {
	const text = source(language);
	const found = text.matchAll(/<section id="(\w+)"[^>]*>(.*?)<\/section>/gs);
	const [intro = ''] = text.split('<section');
	return new Map([['intro', intro], ...[...found].map(([, id = '', body = '']) => [id, body] as const)]);
}

/** Running text of a section, without headings, figures and equations of their own lines. */
const prose = (section: string) =>
	section
		.replace(/\$\$.*?\$\$|<figure.*?<\/figure>/gs, ' ')
		.replace(/^#+ .*$/gm, ' ')
		.replace(/<(?!\/?dfn)[^>]*>/g, ' ');

function length(language: Language, section: string): number {
	const text = prose(section).replace(/<[^>]*>/g, ' ');
	if (language === 'en') return text.split(/\s+/).filter((word) => /\w/.test(word)).length;
	return (text.replace(/\$.*?\$/g, 'x').match(/\p{Script=Han}|[A-Za-z]+|\d+/gu) ?? []).length;
}

describe.each(LANGUAGES)('the text in %s', (language) => {
	const all = sections(language);

	it('is no longer than it was, step by step', () => {
		for (const [id, most] of Object.entries(BEFORE[language]))
			expect(length(language, all.get(id) ?? ''), id).toBeLessThanOrEqual(most);
	});

	it.each(TERMS[language])('explains %s where it first appears, once', (term, section) => {
		const text = [...all].map(([id, body]) => `@${id} ${prose(body)}`).join('\n');
		const first = text.search(term);
		expect(text.slice(0, first)).toMatch(new RegExp(`@${section} [^@]*<dfn>[^<]*$`));
		const defined = [...text.matchAll(/<dfn>(.*?)<\/dfn>/g)].filter(([, inner = '']) => term.test(inner));
		expect(defined).toHaveLength(1);
	});

	it('links its references, and lists no author by a name alone', () => {
		const list = typeset(all.get('more') ?? '');
		expect(list.match(/<li>/g)?.length).toBeGreaterThanOrEqual(7);
		expect(list.match(/href="https:\/\//g)?.length).toBeGreaterThanOrEqual(5);
		for (const [, name = ''] of prose(source(language)).matchAll(/(Yuksel|Yang|杨刚)/g)) expect(list).toContain(name);
	});

	it('sums up what it taught', () => {
		expect(typeset(all.get('recap') ?? '').match(/<li>/g)?.length).toBeGreaterThanOrEqual(5);
	});
});

it('the first author is 唐勇', () => {
	expect(source('zh')).not.toContain('汤');
	expect(source('zh').match(/唐勇/g)).toHaveLength(2);
});

it('English that can be read aloud', () => {
	const spoken = source('en') + JSON.stringify(WORDS.en);
	expect(spoken).not.toMatch(/askew"?[^:]|misses? .{0,10}by least|is hopeless|\baside,? an eye|\bweighed by/);
});

describe('figures in the text', () => {
	it.each(LANGUAGES)('on half-way states agree with the table of the pelt, in %s', (language) => {
		const tables = file('baker/furbake/pelt/README.md').toString();
		const rows = [...tables.matchAll(/^\| \w+ \| [\d.]+, [\d.]+ \| ([\d.]+), [\d.]+ \| \w+, \w+ \|/gm)];
		expect(rows.length).toBeGreaterThanOrEqual(7);
		const least = Math.min(...rows.map(([, r]) => Number(r)));
		const two = /r half-way would be ([\d.]+) \(fox\) to ([\d.]+) \(sheep\)/.exec(tables);
		const said = [...prose(sections(language).get('wet') ?? '').matchAll(/\b0\.\d\d\b/g)].map(([r]) => Number(r));
		expect(said).toEqual([Number(two?.[1]), Number(two?.[2]), Math.floor(100 * least) / 100]);
	});

	it.each(LANGUAGES)('on the error of a texel agree with the measurements, in %s', (language) => {
		const record: LessonRecord = JSON.parse(file('public/lesson/lesson.json').toString());
		const planes = record.planes.map((name) => file(`public/lesson/${name}`));
		const first = record.samples[1];
		const layer = decodeLayer(record, 1, file(`public/lesson/${first?.file}`), planes);
		const curves = polynomial([0, 1, 2, 3, 4, 5]);
		const numbers = new Fit(curves, record.lights.slice(0, record.fitted)).texels(layer.light, layer.texels.length);
		const lamps = Array.from({ length: record.held_out }, (_, i) => record.fitted + i);
		const { all } = blockErrors(
			layer,
			lamps,
			(lamp) => relitTexels(numbers, curves(record.lights[lamp] as [number, number, number])),
			1,
		);
		const said = /(\d+) ?%/.exec(prose(sections(language).get('mean') ?? ''))?.[1];
		expect(said).toBe((100 * all).toFixed(0));
		expect(layer.number + 1).toBe(8);
	});
});
