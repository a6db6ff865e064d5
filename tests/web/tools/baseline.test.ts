import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type { BenchFigures, Method } from '../../../web/measure/bench/results.ts';
import { against, readBaseline } from '../../../web/tools/measure/baseline.mjs';

function result(method: Method, median_ms: number, ratio_to_unlit: number, triangles = 512) {
	const row = { method, light: 'moving' as const, fins: false, triangles, shells: 16, width: 96, height: 64 };
	return { ...row, median_ms, ratio_to_unlit, ratio_to_shadow_layers: 1, overdraw: null };
}

function figures(results: BenchFigures['results'], device = 'a card'): BenchFigures {
	const empty = { results_of_layers: [], growth: [], costs: [], lights: [], card: [] };
	const machine = { device, browser: 'a browser', cores: 2, clock: 'readPixels' as const, rounds: 1, seconds: 1 };
	return { ...machine, ...empty, results, curves: { shells: [], pixels: [] } };
}

const cells = (rows: string[][]) => rows.map((row) => row.join(' | ')).join('\n');
let folder: string;
beforeAll(() => {
	folder = mkdtempSync(join(tmpdir(), 'furbake-baseline-'));
});
afterAll(() => rmSync(folder, { recursive: true }));

function stored(text: string): string {
	const path = join(folder, 'baseline.json');
	writeFileSync(path, text);
	return path;
}

describe('figures beside a baseline', () => {
	it('are ratios of ratios and of times, for the rows of both runs', () => {
		const before = readBaseline(stored(JSON.stringify(figures([result('unlit', 10, 1), result('ptm', 16, 1.6)]))));
		const now = figures([result('unlit', 20, 1), result('ptm', 28, 1.4), result('ptm', 90, 1.5, 4608)]);
		expect(against(before, now, cells).split('\n').slice(2)).toEqual([
			' | of unlit: before | now | now / before | ms: before | now | now / before',
			'unlit, 512 triangles x 16 shells, 96 x 64 | 1.00 | 1.00 | 1.00 | 10.0 | 20.0 | 2.00',
			'ptm, 512 triangles x 16 shells, 96 x 64 | 1.60 | 1.40 | 0.87 | 16.0 | 28.0 | 1.75',
		]);
	});

	it('of another machine come with a warning', () => {
		const [before, now] = [figures([result('ptm', 1, 1)], 'an old card'), figures([result('ptm', 1, 1)])];
		expect(against(before, now, cells)).toMatch(/Another machine: device was an old card\. Compare ratios alone\.$/);
		expect(against(before, figures([result('unlit', 1, 1)]), cells)).toMatch(/no row is in both/);
	});

	it.each(['', '{}', '[]', 'null', '{"results": [{}]}', '{"results": 3}'])('are refused if they are %s', (text) => {
		expect(() => readBaseline(stored(text))).toThrow(/^--baseline: .*baseline\.json: [^\n]+$/);
	});

	it('are refused if there are none', () => {
		expect(() => readBaseline(join(folder, 'nothing.json'))).toThrow(/^--baseline: .*no such file/);
	});
});
