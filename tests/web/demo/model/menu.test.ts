import { readdirSync, readFileSync, statSync } from 'node:fs';
import { decode } from 'fast-png';
import { describe, expect, it } from 'vitest';
import { folderOf, type MenuEntry, offered, pelts } from '../../../../web/demo/model/menu.ts';
import { parseAddress } from '../../../../web/demo/state/address.ts';
import type { Curves, FurAsset, Pelt } from '../../../../web/fur/format.ts';
import { wayOf } from '../../../../web/fur/light/bent.ts';
import { curvedMoments } from '../../../../web/fur/light/curves.ts';
import type { Direction } from '../../../../web/fur/light/moments.ts';

const menu: MenuEntry[] = JSON.parse(
	readFileSync(new URL('../../../../public/models/models.json', import.meta.url), 'utf8'),
);
const base = 'https://example.org/fur/?model=x';
const href = (model: string) => folderOf(model, menu, base)?.href;

const LIGHTS: Direction[] = [
	[0, 0, 1],
	[0.6, 0, 0.8],
	[-0.48, 0.64, 0.6],
	[0.28, -0.96, 0],
];

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
		expect(names).toEqual(['bunny', 'tiger', 'torus', 'sphere']);
		const others = menu.filter(({ name }) => !names.includes(name));
		expect(others.length).toBeGreaterThan(0);
		for (const { name } of others) expect(href(name)).toBe(`https://example.org/fur/models/${name}/`);
	});

	/** Models that wear the fur of a preset; others have one of their own. */
	const dressed = offered(menu).filter(({ preset }) => preset !== undefined);

	it('has a pelt of every preset in either basis, one of them for each model', () => {
		const presets = readdirSync(new URL('../../../../baker/furbake/presets', import.meta.url)).map((name) =>
			name.replace('.toml', ''),
		);
		for (const basis of ['ptm', 'eigen'] as const)
			expect(
				pelts(menu, basis)
					.map(({ pelt }) => pelt)
					.sort(),
			).toEqual(presets.sort());
		for (const { preset } of dressed) expect(presets).toContain(preset);
	});

	it('has for the models that it offers the light that they were baked with, and few bytes at first', () => {
		const file = (path: string) => new URL(`../../../../public/models/${path}`, import.meta.url);
		const gltf = (name: string) => JSON.parse(readFileSync(file(`${name}/model.gltf`), 'utf8'));
		/** Of every eighth texel of the first state: its light from some directions, α and tint, a list per direction or channel. */
		const texels = (name: string) => {
			const { images, extensions } = gltf(name);
			const asset: FurAsset = extensions.FUR_ptm_shells;
			const { planes, scale, bias, weights = [] } = asset.pelts[0] as Pelt;
			const means = { curves: asset.curves as Curves, way: wayOf(asset) };
			const slab = (asset.size * asset.size) / 8;
			const decoded = planes.map((i) => decode(readFileSync(file(`${name}/${images[i].uri}`))).data as Uint8Array);
			const [p0, p1] = decoded as [Uint8Array, Uint8Array];
			const channel = (of: Uint8Array, c: number) =>
				Array.from({ length: of.length / 32 }, (_, t) => of[32 * t + c] ?? 0);
			const bytes = [0, 1, 2].map((c) => channel(p0, c)).concat([channel(p1, 0), channel(p1, 1), channel(p0, 3)]);
			const light = LIGHTS.map((direction) => {
				const moments = weights.map((row) => curvedMoments(asset.basis, means, direction, row, 4));
				return bytes[0]?.map((_, t) => {
					const own = moments[Math.floor(t / slab)] ?? [];
					return own.reduce((sum, m, i) => sum + m * (scale[i] ?? 0) * ((bytes[i]?.[t] ?? 0) - (bias[i] ?? 0)), 0);
				}) as number[];
			});
			return { light, cover: [channel(p1, 2), channel(p1, 3)] };
		};
		for (const { name, preset } of dressed) {
			const [own, pelt] = [texels(name), texels(`pelt-${preset}`)];
			expect(own.cover.every((of, c) => of.every((byte, at) => byte === pelt.cover[c]?.[at]))).toBe(true);
			// Mean curves and λ for all states of the pelt suit dry fur a little less than those of the model alone.
			own.light.forEach((of, i) => {
				const most = (values: number[]) => values.sort((a, b) => a - b)[Math.floor(0.99 * values.length)] ?? 0;
				const apart = most(
					of.map((value, at) => (own.cover[0]?.[at] ? Math.abs(value - (pelt.light[i]?.[at] ?? 0)) : 0)),
				);
				expect(apart).toBeLessThan(0.11 * most([...of]));
			});
		}
		for (const { name } of [...pelts(menu), ...pelts(menu, 'eigen')]) {
			const { images, extensions } = gltf(name);
			const { planes, colour, fin } = extensions.FUR_ptm_shells.pelts[0];
			const first = [...planes, colour, ...fin.planes, fin.colour].filter((i) => i !== undefined);
			const uris = ['model.gltf', 'model.bin', ...first.map((i: number) => images[i].uri)];
			expect(uris.reduce((sum, uri) => sum + statSync(file(`${name}/${uri}`)).size, 0)).toBeLessThan(550_000);
			const whole = readdirSync(file(name)).reduce((sum, path) => sum + statSync(file(`${name}/${path}`)).size, 0);
			expect(whole).toBeLessThan(3_000_000);
		}
	});

	it('says of each pelt what was baked', () => {
		for (const { name, pelt, basis = 'ptm', wet = false, dirt = false } of menu) {
			if (!pelt) continue;
			const file = new URL(`../../../../public/models/${name}/model.gltf`, import.meta.url);
			const asset: FurAsset = JSON.parse(readFileSync(file, 'utf8')).extensions.FUR_ptm_shells;
			const states = {
				wet: asset.pelts.some(({ wetness = 0 }) => wetness > 0),
				dirt: asset.pelts.some(({ dirt: mud = 0 }) => mud > 0),
			};
			expect({ basis: asset.basis.kind, ...states }, name).toEqual({ basis, wet, dirt });
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
