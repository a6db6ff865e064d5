import { describe, expect, it } from 'vitest';
import { markdown, table } from '../../../web/tools/measure/table.mjs';

const rows = [
	['', 'ms', 'of unlit'],
	['unlit', '66.7', '× 1.00'],
	['PTM, fins', '100', '× 1.50'],
];

describe('a table', () => {
	it('stands in columns, names to the left and figures to the right', () => {
		expect(table(rows).split('\n')).toEqual([
			'              ms   of unlit',
			'unlit       66.7     × 1.00',
			'PTM, fins    100     × 1.50',
		]);
	});

	it('is Markdown on request', () => {
		expect(markdown(rows).split('\n')).toEqual([
			'|  | ms | of unlit |',
			'|---|---:|---:|',
			'| unlit | 66.7 | × 1.00 |',
			'| PTM, fins | 100 | × 1.50 |',
		]);
	});
});
