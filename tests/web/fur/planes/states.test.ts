import { encode } from 'fast-png';
import { describe, expect, it } from 'vitest';
import type { FurAsset, Pelt } from '../../../../web/fur/format.ts';
import { decodePlanes, type PlaneFile } from '../../../../web/fur/planes/mipLevels.ts';
import { type Cut, PeltStates } from '../../../../web/fur/planes/PeltStates.ts';
import { textureArray } from '../../../../web/fur/planes/planes.ts';
import { pairFor, placeOf, statesOf, traitsOf } from '../../../../web/fur/planes/states.ts';

const FIVE = [0, 0.25, 0.5, 0.75, 1];
const pelt = (name: string, more: Partial<Pelt> = {}) => ({ name, ...more }) as Pelt;

describe('states', () => {
	it('are those that are wet, and the one that is dirty; other pelts are none', () => {
		const pelts = [pelt('dry'), pelt('fox'), pelt('wet', { wetness: 1 }), pelt('dirty', { dirt: 1 })];
		const { wet, dirty } = statesOf({ pelts } as FurAsset);
		expect(wet.map(({ name }) => name)).toEqual(['dry', 'wet']);
		expect(dirty?.name).toBe('dirty');
		expect(traitsOf(pelt('plain'))).toEqual([1, 1, 1, 1]);
		expect(traitsOf(pelt('wet', { length: 0.85, shade: 0.5, gloss: 2, sharpness: 4 }))).toEqual([0.85, 0.5, 2, 4]);
	});

	it.each([
		[0, 0, [0]],
		[0, 0.1, [0, 1]],
		[0, 1, [0, 4]],
		[0.3, 0.4, [1, 2]],
		[0.5, 0.5, [2, 3]],
		[0.5, 0.75, [2, 3]],
		[0.2, 0.6, [0, 3]],
		[1, 1, [3, 4]],
	])('from %f to %f it takes %j of five', (from, to, pair) => {
		expect(pairFor(FIVE, from, to)).toEqual(pair);
	});

	it('with none but the dry one it takes that', () => {
		expect(pairFor([0], 0.2, 0.7)).toEqual([0]);
		expect(pairFor([0, 0.6], 0.2, 0.9)).toEqual([0, 1]);
	});

	it('lie evenly on the way from dry to soaked, whatever their wetness', () => {
		expect(FIVE.map((wetness) => placeOf(FIVE, wetness))).toEqual([0, 1, 2, 3, 4]);
		expect(placeOf(FIVE, 0.6)).toBeCloseTo(2.4, 9);
		expect(placeOf([0, 0.2, 1], 0.6)).toBeCloseTo(1.5, 9);
		expect(placeOf([0.5, 0.75], 0.1)).toBe(0);
		expect(placeOf([0.5, 0.75], 1)).toBe(1);
	});
});

const SIZE = 4;
const LAYERS = 2;
const extent = { width: SIZE, height: SIZE, layers: LAYERS };

/** Planes of one value each, but for the coverage, which is full. */
async function file(role: 'plane0' | 'plane1', value: number): Promise<PlaneFile> {
	const data = new Uint8Array(SIZE * SIZE * LAYERS * 4).fill(value);
	if (role === 'plane1') for (let i = 2; i < data.length; i += 4) data[i] = 255;
	return {
		role,
		name: `${role} of ${value}`,
		bytes: encode({ width: SIZE, height: SIZE * LAYERS, channels: 4, data }),
	};
}

/** A pelt of three wet states and a dirty one, their planes filled with 0, 50, 100 and 200. */
async function peltOf(most: number, layers = 256, broken = false) {
	const pelts = [
		pelt('dry'),
		pelt('moist', { wetness: 0.5 }),
		pelt('soaked', { wetness: 1 }),
		pelt('dirty', { dirt: 1 }),
	];
	const layout = { extent, coefficients: 6, rise: 0.5 };
	const both = (value: number) => Promise.all([file('plane0', value), file('plane1', value)]);
	const planes = await decodePlanes(await both(0), layout);
	const textures = Object.fromEntries(
		planes.map(({ role, name, levels }) => [role, textureArray(name, levels, extent)]),
	) as never as Cut['textures'];
	textures.plane0.anisotropy = 7;
	let fetched = 0;
	let bad = broken;
	const cut: Cut = {
		textures,
		layout,
		async fetch({ name }) {
			fetched++;
			if (bad && name === 'soaked') {
				bad = false;
				throw new Error('soaked-plane0.png: could not be loaded (gone)');
			}
			return both({ moist: 50, soaked: 100, dirty: 200 }[name] ?? 0);
		},
	};
	const states = new PeltStates({ pelts } as FurAsset, [cut], most, layers);
	const stacks = () => {
		const { image, mipmaps } = textures.plane0 as never as {
			image: { depth: number };
			mipmaps: { data: Uint8Array }[];
		};
		const [level] = mipmaps;
		if (!level) throw new Error('no levels');
		const size = SIZE * SIZE * LAYERS * 4;
		const values = Array.from({ length: level.data.length / size }, (_, i) => level.data[i * size]);
		return { values, depth: image.depth, levels: mipmaps.length };
	};
	return { states, textures, stacks, fetched: () => fetched };
}

describe('the states of a pelt', () => {
	it('are not fetched before they are wanted, then once, and stacked with all their levels', async () => {
		const { states, textures, stacks, fetched } = await peltOf(Number.POSITIVE_INFINITY);
		let told = 0;
		states.subscribe(() => told++);
		expect([fetched(), states.loaded]).toEqual([0, false]);
		expect(stacks()).toEqual({ values: [0], depth: LAYERS, levels: 3 });
		const before = textures.plane0;
		let freed = false;
		before.addEventListener('dispose', () => {
			freed = true;
		});
		await Promise.all([states.load(), states.load()]);
		expect([fetched(), told, freed, states.loaded]).toEqual([3, 1, true, true]);
		expect(stacks()).toEqual({ values: [0, 50, 100, 200], depth: 4 * LAYERS, levels: 3 });
		expect([states.wet.length, states.dirty, textures.plane0.anisotropy]).toEqual([3, true, 7]);
	});

	it('that fail leave all as it was, and can be tried again', async () => {
		const { states, textures, stacks } = await peltOf(Number.POSITIVE_INFINITY, 256, true);
		const before = textures.plane0;
		await expect(states.load()).rejects.toThrow('soaked-plane0.png: could not be loaded (gone)');
		expect(textures.plane0).toBe(before);
		expect(states.loaded).toBe(false);
		await states.load();
		expect(stacks().values).toEqual([0, 50, 100, 200]);
	});

	it.each([
		['asked for two', 2, 256],
		['a texture takes no more', Number.POSITIVE_INFINITY, 7],
	])('where %s are the two around the wetness of all who wear it', async (_, most, layers) => {
		const { states, stacks, fetched } = await peltOf(most, layers);
		const [one, other, unseen] = [() => {}, () => {}, () => {}];
		states.subscribe(one);
		states.subscribe(other);
		// Nobody asks how wet that one is, nor is that a third one who is no longer seen.
		states.subscribe(unseen);
		states.request(() => {}, 1, 0);
		await states.load();
		expect([fetched(), states.loaded, states.dirty]).toEqual([3, true, false]);
		expect(stacks().values).toEqual([0]);
		states.request(one, 0.6, 0.8);
		states.request(other, 0.7, 1);
		await expect.poll(() => stacks().values).toEqual([50, 100]);
		expect(stacks().depth).toBe(2 * LAYERS);
		states.request(one, 0.1, 0.8);
		await expect.poll(() => stacks().values).toEqual([0, 100]);
		states.request(other, 0, 0);
		states.request(one, 0, 0.4);
		await expect.poll(() => stacks().values).toEqual([0, 50]);
		states.request(one, 0, 0);
		expect(stacks().values, 'at once').toEqual([0]);
		expect(fetched()).toBe(3);
	});

	it('are freed, and none come after that', async () => {
		const { states, textures } = await peltOf(Number.POSITIVE_INFINITY);
		const before = textures.plane0;
		const loading = states.load();
		states.dispose();
		await loading;
		expect(textures.plane0).toBe(before);
	});
});
