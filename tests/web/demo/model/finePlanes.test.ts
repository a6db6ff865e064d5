import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { type Device, wantsFine } from '../../../../web/demo/model/finePlanes.ts';
import { type MenuEntry, pelts } from '../../../../web/demo/model/menu.ts';

const desk: Device = { coarse: false, side: 1080, memory: 8, saving: false };
const read = (path: string) =>
	JSON.parse(readFileSync(fileURLToPath(new URL(`../../../../public/models/${path}`, import.meta.url)), 'utf8'));
const menu: MenuEntry[] = read('models.json');

describe('finer planes', () => {
	it('are for those who ask for them, and by themselves for devices that are up to it', () => {
		const wanted = (part: Partial<Device>) => wantsFine(undefined, () => ({ ...desk, ...part }));
		expect(wanted({})).toBe(true);
		expect(wanted({ memory: undefined })).toBe(true);
		expect(wanted({ coarse: true })).toBe(false);
		expect(wanted({ side: 414 })).toBe(false);
		expect(wanted({ memory: 2 })).toBe(false);
		expect(wanted({ saving: true })).toBe(false);
		expect(wantsFine('64', () => desk)).toBe(false);
		expect(wantsFine('128', () => ({ coarse: true, side: 320, memory: 1, saving: true }))).toBe(true);
	});

	const fine = menu.filter((entry) => entry.fine);

	it('are there for what the page shows first', () => {
		expect(fine.map(({ pelt }) => pelt)).toContain(menu[0]?.preset);
	});

	it.each(fine)(
		'$name holds the very hairs of the models and the pelt of its preset, and is none to choose',
		(entry) => {
			expect(pelts(menu)).not.toContain(entry);
			const { layers, size, ...own } = read(`${entry.name}/bake.json`).options;
			expect(layers * size ** 2).toBeGreaterThan(16 * 64 ** 2);
			const others = menu.filter(
				({ pelt, preset, fine, basis }) => !fine && basis !== 'eigen' && (preset ?? pelt) === entry.pelt,
			);
			expect(others.length).toBeGreaterThan(0);
			for (const { name } of others) {
				const { options } = read(`${name}/bake.json`);
				for (const knob of ['coat', 'ramp', 'seed', 'colour_plane', 'tile_share', 'height_share', 'basis'] as const)
					expect(options[knob], `${knob} of ${name}`).toEqual(own[knob]);
			}
		},
	);
});
