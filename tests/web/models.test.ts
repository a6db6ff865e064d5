import { readdirSync, readFileSync, statSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { parseAddress } from '../../web/demo/address.ts';
import { folderOf, type MenuEntry, offered, pelts } from '../../web/demo/models.ts';

const menu: MenuEntry[] = JSON.parse(readFileSync(new URL('../../public/models/models.json', import.meta.url), 'utf8'));
const base = 'https://example.org/fur/?model=x';
const href = (model: string) => folderOf(model, menu, base)?.href;

describe('the menu', () => {
	it('begins with the bunny, and each entry has a name of its own and a title', () => {
		expect(menu[0]?.name).toBe('bunny');
		expect(new Set(menu.map(({ name }) => name)).size).toBe(menu.length);
		for (const { name, title } of menu) {
			expect(name).toMatch(/^[a-z][a-z0-9-]*$/);
			expect(title).not.toBe('');
		}
	});

	it('leaves out what is only for measuring, which has a name all the same', () => {
		const names = offered(menu).map(({ name }) => name);
		expect(names).toEqual(['bunny', 'torus', 'sphere']);
		const others = menu.filter(({ name }) => !names.includes(name));
		expect(others.length).toBeGreaterThan(0);
		for (const { name } of others) expect(href(name)).toBe(`https://example.org/fur/models/${name}/`);
	});

	it('has a pelt of every preset in either basis, one of them for each model', () => {
		const presets = readdirSync(new URL('../../baker/furbake/presets', import.meta.url)).map((name) =>
			name.replace('.toml', ''),
		);
		for (const basis of ['ptm', 'eigen'] as const)
			expect(
				pelts(menu, basis)
					.map(({ pelt }) => pelt)
					.sort(),
			).toEqual(presets.sort());
		for (const { preset } of offered(menu)) expect(presets).toContain(preset);
	});

	it('has for the models that it offers the very planes that they were baked with, and few bytes beside', () => {
		const file = (path: string) => new URL(`../../public/models/${path}`, import.meta.url);
		for (const { name, preset } of offered(menu)) {
			const planes = readdirSync(file(name)).filter((path) => path.endsWith('.png'));
			expect(planes.length).toBeGreaterThanOrEqual(4);
			for (const plane of planes)
				expect(readFileSync(file(`pelt-${preset}/${plane}`)).equals(readFileSync(file(`${name}/${plane}`)))).toBe(true);
		}
		const bytes = [...pelts(menu), ...pelts(menu, 'eigen')].map(({ name }) =>
			readdirSync(file(name)).reduce((sum, path) => sum + statSync(file(`${name}/${path}`)).size, 0),
		);
		for (const size of bytes) expect(size).toBeLessThan(500_000);
	});

	it('has first views that the address understands', () => {
		for (const { view = '' } of menu) expect(parseAddress(view).problems).toEqual([]);
	});
});

describe('the folder of a model', () => {
	it.each([
		['bunny', 'https://example.org/fur/models/bunny/'],
		['models/bunny', 'https://example.org/fur/models/bunny/'],
		['models/bunny/', 'https://example.org/fur/models/bunny/'],
		['models/bunny/model.gltf', 'https://example.org/fur/models/bunny/'],
		['../out', 'https://example.org/out/'],
		['/out/fox', 'https://example.org/out/fox/'],
		['http://localhost:8000/fox/', 'http://localhost:8000/fox/'],
	])('%s is %s', (model, folder) => {
		expect(href(model)).toBe(folder);
	});

	it.each(['cat', '', 'javascript:alert(1)/', 'data:text/plain,x', 'file:///etc/', 'http://'])(
		'%j is none',
		(model) => {
			expect(href(model)).toBeUndefined();
		},
	);
});
