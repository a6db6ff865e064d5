import { readdirSync, readFileSync, statSync } from 'node:fs';
import { decode } from 'fast-png';
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

	it('has for the models that it offers the light that they were baked with, to a byte, and few bytes at first', () => {
		const file = (path: string) => new URL(`../../public/models/${path}`, import.meta.url);
		const gltf = (name: string) => JSON.parse(readFileSync(file(`${name}/model.gltf`), 'utf8'));
		/** Of every eighth texel of the first state: its coefficients, α and tint, a list per channel. */
		const texels = (name: string) => {
			const { images, extensions } = gltf(name);
			const { planes, scale, bias } = extensions.FUR_ptm_shells.pelts[0];
			const [p0, p1] = planes.map((i: number) => decode(readFileSync(file(`${name}/${images[i].uri}`))).data);
			const channel = (of: Uint8Array, c: number) =>
				Array.from({ length: of.length / 32 }, (_, t) => of[32 * t + c] ?? 0);
			const bytes = [0, 1, 2].map((c) => channel(p0, c)).concat([channel(p1, 0), channel(p1, 1), channel(p0, 3)]);
			const light = bytes.map((of, i) => of.map((byte) => scale[i] * (byte - bias[i])));
			return { light, cover: [channel(p1, 2), channel(p1, 3)], scale };
		};
		for (const { name, preset } of offered(menu)) {
			const [own, pelt] = [texels(name), texels(`pelt-${preset}`)];
			expect(own.cover.every((of, c) => of.every((byte, at) => byte === pelt.cover[c]?.[at]))).toBe(true);
			// One λ for all states of the pelt is coarser than one for the dry fur of the model alone.
			own.light.forEach((of, i) => {
				const apart = of.map((value, at) => Math.abs(value - (pelt.light[i]?.[at] ?? 0))).sort((a, b) => a - b);
				expect(apart[Math.floor(0.99 * apart.length)]).toBeLessThan(3 * pelt.scale[i]);
			});
		}
		for (const { name } of [...pelts(menu), ...pelts(menu, 'eigen')]) {
			const { images, extensions } = gltf(name);
			const { planes, colour, fin } = extensions.FUR_ptm_shells.pelts[0];
			const first = [...planes, colour, ...fin.planes, fin.colour].filter((i) => i !== undefined);
			const uris = ['model.gltf', 'model.bin', ...first.map((i: number) => images[i].uri)];
			expect(uris.reduce((sum, uri) => sum + statSync(file(`${name}/${uri}`)).size, 0)).toBeLessThan(500_000);
			const whole = readdirSync(file(name)).reduce((sum, path) => sum + statSync(file(`${name}/${path}`)).size, 0);
			expect(whole).toBeLessThan(3_000_000);
		}
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
