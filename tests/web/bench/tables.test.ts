import { describe, expect, it } from 'vitest';
import { sections } from '../../../web/bench/report.ts';
import { articleTable, cardTable, methodTable, overdrawTable, titleOf } from '../../../web/bench/tables.ts';
import { WORDS } from '../../../web/bench/words/index.ts';
import type { BenchFigures, Result } from '../../../web/measure/bench/results.ts';

const { en, zh } = WORDS;
const row = (more: Partial<Result>): Result => ({
	method: 'ptm',
	light: 'moving',
	fins: false,
	triangles: 512,
	shells: 16,
	width: 1280,
	height: 720,
	median_ms: 100,
	ratio_to_unlit: 1.5,
	ratio_to_shadow_layers: 0.5,
	overdraw: null,
	...more,
});
const results = [
	row({ method: 'unlit', median_ms: 66.7, ratio_to_unlit: 1 }),
	row({ method: 'shadow-layers', median_ms: 250 }),
	row({ overdraw: { covered: 0.25, shaded: 13.75, blended: 9.3 } }),
	row({ light: 'still', median_ms: 99 }),
	row({ triangles: 4608, median_ms: 1234 }),
];
const figures: BenchFigures = {
	device: 'SwiftShader',
	browser: 'Chromium',
	cores: 2,
	clock: 'readPixels',
	rounds: 7,
	seconds: 700,
	results,
	results_of_layers: [],
	growth: [{ method: 'ptm', from: 512, to: 4608, ratio: 1.23 }],
	costs: [],
	lights: [],
	curves: { shells: [], pixels: [] },
	card: [],
};
/** With plain spaces. */
const plain = (rows: string[][]) => rows.map((cells) => cells.map((cell) => cell.replaceAll('\u00a0', ' ')));

describe('the table of methods', () => {
	it('has a row for every rival and two columns for every number of triangles', () => {
		const { head, rows } = methodTable(results, en);
		expect(plain([head])).toEqual([['', '512: ms', 'of unlit', '4 608: ms', 'of unlit']]);
		expect(plain(rows)).toEqual([
			['unlit', '66.7', '× 1.00', '–', '–'],
			['shadow layers', '250', '× 1.50', '–', '–'],
			['PTM', '100', '× 1.50', '1234', '× 1.50'],
			['PTM, still light', '99.0', '× 1.50', '–', '–'],
		]);
	});

	it('has no two rivals of one name', () => {
		expect(titleOf(row({ fins: true }), en)).toBe('PTM, fins');
		expect(titleOf(row({ method: 'shadow-layers', light: 'still' }), en)).toBe('shadow layers, still light');
	});
});

describe("the article's table", () => {
	it('stands beside what was measured here, read both ways', () => {
		const coarse = [
			row({ triangles: 32, median_ms: 10 }),
			row({ method: 'shadow-layers', triangles: 32, median_ms: 40 }),
		];
		const { rows } = articleTable({ results, results_of_layers: coarse }, en);
		expect(plain(rows)).toEqual([
			['512, the article', '41.6', '57.3', '× 1.38'],
			['512, here', '4.00', '10.0', '× 2.00'],
			['512, here, all layers together', '25.0', '100', '× 2.00'],
			['4 608, the article', '14.3', '17.4', '× 1.22'],
			['16 896, the article', '5.70', '7.70', '× 1.35'],
		]);
	});
});

describe('the table of a graphics card', () => {
	it('has a row per number of shells and bodies, a column per size, and dashes where nothing was measured', () => {
		const point = (bodies: number, height: number, median_ms: number) => ({
			...row({ fins: true, width: (16 * height) / 9, height, median_ms }),
			bodies,
		});
		const { head, rows } = cardTable([point(1, 1080, 0.5), point(1, 2160, 2), point(100, 1080, 12.5)], en);
		expect([head, ...rows]).toEqual([
			['', '1920 × 1080', '3840 × 2160'],
			['16 shells, one body', '0.500 (2000)', '2.00 (500)'],
			['16 shells, 100 bodies', '12.5 (80.0)', '–'],
		]);
	});
});

describe('the report', () => {
	it('has what there is', () => {
		expect(sections({ ...figures, results: [] }, en)).toEqual([]);
		expect(sections(figures, en).map(({ title }) => title)).toEqual([
			'Methods',
			"The article's Table 1",
			'Overdraw',
			'What a frame grows with',
		]);
		expect(sections(figures, en)[0]?.text).toContain(
			'. A frame of PTM grows from 512 to 4\u00a0608 triangles ×\u00a01.23',
		);
		expect(sections(figures, zh)[0]?.text).toMatch(/。PTM/);
	});

	it('has the same numbers in Chinese, under Chinese words', () => {
		const everything: BenchFigures = {
			...figures,
			results_of_layers: [row({ triangles: 32 }), row({ method: 'shadow-layers', triangles: 32 })],
			costs: [{ name: 'plain', median_ms: 10, ratio: 1 }],
			lights: [{ name: '8 lights', median_ms: 11, ratio: 1.1 }],
			card: [{ ...row({ fins: true, median_ms: 4, width: 1920, height: 1080 }), bodies: 100 }],
		};
		const [english, chinese] = [sections(everything, en), sections(everything, zh)];
		const numbers = (those: typeof english) =>
			those.flatMap(({ tables }) => tables.map(({ rows }) => rows.map(([, ...cells]) => cells)));
		expect(numbers(chinese)).toEqual(numbers(english));
		const said = chinese.flatMap(({ title, text, tables }) => [title, text, ...tables.map(({ caption }) => caption)]);
		for (const words of said) expect(words).toMatch(/\p{Script=Han}/u);
		expect(chinese.map(({ plots }) => plots.length)).toEqual(english.map(({ plots }) => plots.length));
	});

	it('tells the overdraw of those rivals that have one', () => {
		expect(overdrawTable(results, en).rows[0]?.slice(1)).toEqual(['25 %', '13.8', '9.3']);
	});
});
