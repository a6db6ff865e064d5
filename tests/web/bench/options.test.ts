import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { parseOptions } from '../../../web/bench/options.ts';
import { DEFAULTS, QUICK, TORI } from '../../../web/measure/bench/plan.ts';

describe('the address of the bench', () => {
	it('asks for nothing by itself', () => {
		expect(parseOptions('')).toEqual({ options: DEFAULTS, quick: false, run: false, post: undefined, problems: [] });
	});

	it('says what to measure', () => {
		const { options, run, post, problems } = parseOptions(
			'?run=1&post=/figures&rounds=3&size=96x64&parts=costs,results&methods=ptm,unlit&triangles=512',
		);
		expect(problems).toEqual([]);
		expect(run).toBe(true);
		expect(post).toBe('/figures');
		expect(options).toEqual({
			rounds: 3,
			width: 96,
			height: 64,
			parts: ['results', 'costs'],
			methods: ['unlit', 'ptm'],
			triangles: [512],
		});
	});

	it('changes a quick look as it does the whole', () => {
		expect(parseOptions('?quick=1&rounds=5').options).toEqual({ ...QUICK, rounds: 5 });
	});

	it.each([
		'rounds=0',
		'rounds=many',
		'size=8x8',
		'size=1280',
		'parts=all',
		'methods=',
		'methods=ptm,magic',
		'triangles=513',
		'post=//elsewhere.example/',
		'post=https://elsewhere.example/',
		'post=/\\elsewhere.example/',
		'post=/\t/elsewhere.example/',
	])('is told off for %s, and the default stands', (query) => {
		const { options, post, problems } = parseOptions(`?${query}`);
		expect(problems).toHaveLength(1);
		expect(problems[0]?.given).toBe(query);
		expect(options).toEqual(DEFAULTS);
		expect(post).toBeUndefined();
	});
});

describe('the tori of the bench', () => {
	it.each([...TORI])('$triangles triangles are $rows × $columns cells, as baked', ({ triangles, rows, columns }) => {
		expect(2 * rows * columns).toBe(triangles);
		const url = new URL(`../../../public/models/torus-${triangles}/model.gltf`, import.meta.url);
		const { nodes, meshes, accessors, extensions } = JSON.parse(readFileSync(url, 'utf8'));
		const [{ attributes, indices }] = meshes[nodes[extensions.FUR_ptm_shells.shells].mesh].primitives;
		expect(accessors[attributes.POSITION].count).toBe((rows + 1) * (columns + 1));
		expect(accessors[indices].count).toBe(3 * triangles);
		expect(extensions.FUR_ptm_shells.pelts[0].colour, 'a colour plane').toBeUndefined();
	});
});
