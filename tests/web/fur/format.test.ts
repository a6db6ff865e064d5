import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { parseFur } from '../../../web/fur/format/extension.ts';
import { alphaChannel, channelOf, type FurAsset, type Pelt } from '../../../web/fur/format.ts';

/** A golden extension with the side view that fins need. */
const withFins = (name = 'ptm-6'): FurAsset & Record<string, unknown> => {
	const gltf = JSON.parse(readFileSync(new URL(`../../golden/${name}/model.gltf`, import.meta.url), 'utf8'));
	const fur = gltf.extensions.FUR_ptm_shells;
	const row = new Array(9).fill(0.1);
	const six = [1, 2, 3, 4, 5, 6];
	fur.fins = 2;
	fur.pelts[0].fin = {
		width: 64,
		height: 16,
		planes: [3, 4],
		scale: six,
		bias: six,
		basis: { kind: 'ptm' },
		environment: six.map(() => row),
	};
	return fur;
};

/** A golden extension of several states. */
const withStates = (): FurAsset =>
	JSON.parse(readFileSync(new URL('../../golden/states/model.gltf', import.meta.url), 'utf8')).extensions
		.FUR_ptm_shells;

const golden = (name = 'ptm-6'): FurAsset & Record<string, unknown> =>
	JSON.parse(readFileSync(new URL(`../../golden/${name}/model.gltf`, import.meta.url), 'utf8')).extensions
		.FUR_ptm_shells;

const zeros = (rows: number) => Array.from({ length: rows }, () => new Array(9).fill(0));

describe('parseFur', () => {
	it.each(['ptm-6', 'eigen-6', 'eigen-3', 'ptm-6-curves'])('takes what the baker writes: %s', (name) => {
		const gltf = JSON.parse(readFileSync(new URL(`../../golden/${name}/model.gltf`, import.meta.url), 'utf8'));
		expect(parseFur(gltf.extensions.FUR_ptm_shells)).toEqual(gltf.extensions.FUR_ptm_shells);
	});

	it.each(['ptm-6', 'eigen-6', 'eigen-3'])('takes fins of six coefficients, whatever the pelt has: %s', (name) => {
		expect(parseFur(withFins(name))?.pelts[0]?.fin?.scale).toHaveLength(6);
	});

	it.each<[string, (fur: FurAsset) => void, RegExp]>([
		['a side view without a width', (fur) => Reflect.deleteProperty(fur.pelts[0]?.fin ?? {}, 'width'), /fin/],
		['a scale too few', (fur) => fur.pelts[0]?.fin?.scale.pop(), /fin.scale: got 5 entries, expected 6/],
		['an environment too short', (fur) => fur.pelts[0]?.fin?.environment?.pop(), /fin.environment: got 5 entries/],
		['a plane too few', (fur) => fur.pelts[0]?.fin?.planes.pop(), /fin.planes: got 1 entries, expected 2/],
		['tiles below one', (fur) => Object.assign(fur, { tiles: 0.5 }), /tiles/],
	])('refuses %s of fins in one sentence', (_, breakIt, message) => {
		const fur = withFins();
		breakIt(fur);
		expect(() => parseFur(fur)).toThrow(message);
	});

	it('takes states of one fur, in any order of wet and dirty ones, and other pelts beside them', () => {
		expect(parseFur(withStates())?.pelts.map(({ name }) => name)).toEqual(['dry', 'moist', 'wet', 'soaked', 'dirty']);
		const fur = withStates();
		const [dry, moist, wet, soaked, dirty] = fur.pelts;
		fur.pelts = [dry, dirty, moist, { ...dry, name: 'other', scale: [1, 1, 1, 1, 1, 1] }, wet, soaked] as Pelt[];
		expect(parseFur(fur)).toBe(fur);
	});

	it.each<[string, (pelts: Pelt[], fur: FurAsset) => void, string]>([
		['a first one that is wet', ([dry]) => Object.assign(dry ?? {}, { wetness: 0.5 }), 'the dry and clean one'],
		[
			'wet dirt',
			(pelts) => Object.assign(pelts[4] ?? {}, { wetness: 1 }),
			'dirty: got wetness 1 with dirt 1, expected',
		],
		[
			'falling wetness',
			(pelts) => pelts.splice(1, 2, ...pelts.slice(1, 3).reverse()),
			'moist.wetness: got 0.5, expected',
		],
		['two as wet', (pelts) => Object.assign(pelts[2] ?? {}, { wetness: 0.5 }), 'wet.wetness: got 0.5, expected more'],
		[
			'a second dirty one',
			(pelts) => pelts.push({ ...(pelts[4] as Pelt), name: 'filthy' }),
			'filthy.dirt: got 1, expected',
		],
		[
			'another λ',
			(pelts) => Object.assign(pelts[1] ?? {}, { scale: [1, 2, 3, 4, 5, 6] }),
			'moist.scale: got 1,2,3,4,5,6',
		],
		['another Ω of a fin', (pelts) => pelts[3]?.fin?.bias.splice(0, 1, 77), 'soaked.fin.bias: got 77,'],
		[
			'a fin too few',
			(pelts) => Reflect.deleteProperty(pelts[2] ?? {}, 'fin'),
			'wet.fin.scale: got undefined, expected',
		],
		[
			'a colour plane too many',
			(pelts) => Object.assign(pelts[1] ?? {}, { colour: 1 }),
			'moist.colour: got true, expected',
		],
		['a wetness of two', (pelts) => Object.assign(pelts[1] ?? {}, { wetness: 2 }), 'pelts/1'],
		[
			'no mud',
			(_, fur) => Reflect.deleteProperty(fur, 'mud'),
			'FUR_ptm_shells/mud: got none, expected the colour of dirt',
		],
	])('refuses states with %s', (_, breakIt, message) => {
		const fur = withStates();
		breakIt(fur.pelts, fur);
		expect(() => parseFur(fur)).toThrow(message);
	});

	it('takes a pelt with directions, and refuses a reference that is none', () => {
		const fur = golden();
		expect(fur.pelts[0]).not.toHaveProperty('direction');
		Object.assign(fur.pelts[0] ?? {}, { direction: 2 });
		expect(parseFur(fur)?.pelts[0]?.direction).toBe(2);
		Object.assign(fur.pelts[0] ?? {}, { direction: 'up' });
		expect(() => parseFur(fur)).toThrow(/pelts\/0/);
	});

	it('leaves a newer major version alone and takes a newer minor one', () => {
		expect(parseFur({ version: '3.0', whatever: 1 })).toBeUndefined();
		expect(parseFur({ ...golden(), version: '1.7' })).toBeDefined();
	});

	it.each<[string, (fur: FurAsset & Record<string, unknown>) => void, RegExp]>([
		['no version', (fur) => Reflect.deleteProperty(fur, 'version'), /version/],
		['no pelts', (fur) => Object.assign(fur, { pelts: [] }), /FUR_ptm_shells\/pelts/],
		['a size that is a word', (fur) => Object.assign(fur, { size: 'big' }), /FUR_ptm_shells\/size/],
		['seven coefficients', (fur) => Object.assign(fur, { coefficients: 7 }), /FUR_ptm_shells\/coefficients/],
		['a negative length', (fur) => Object.assign(fur, { length: -1 }), /FUR_ptm_shells\/length/],
		['too little drift', (fur) => fur.drift.pop(), /drift: got 3 entries, expected 4/],
		['a scale too few', (fur) => fur.pelts[0]?.scale.pop(), /scale/],
		['a plane too few', (fur) => fur.pelts[0]?.planes.pop(), /planes/],
		['an environment too short', (fur) => fur.environment?.pop(), /environment/],
		['null', () => undefined, /FUR_ptm_shells/],
	])('refuses %s in one sentence', (what, breakIt, message) => {
		const fur = golden();
		breakIt(fur);
		expect(() => parseFur(what === 'null' ? null : fur)).toThrow(message);
	});
});

describe('parseFur of format 2.0', () => {
	it.each<[string, (fur: FurAsset) => void, RegExp]>([
		['no curves', (fur) => Reflect.deleteProperty(fur, 'curves'), /curves/],
		['a pelt without weights', (fur) => Reflect.deleteProperty(fur.pelts[0] ?? {}, 'weights'), /pelts\/0|weights/],
		['weights of too few slabs', (fur) => fur.pelts[0]?.weights?.pop(), /dry.weights: got 3 entries, expected 4/],
		['a weight too few', (fur) => fur.pelts[0]?.weights?.[2]?.pop(), /dry.weights.2: got 2 entries, expected 3/],
		['a table too few', (fur) => fur.curves?.along.pop(), /curves.along: got 2 entries, expected 3/],
		['a radius too few', (fur) => fur.curves?.even[1]?.pop(), /curves\/even\/1/],
		['a knot too few', (fur) => fur.curves?.even[1]?.[0]?.pop(), /curves\/even\/1\/0/],
		[
			'an environment',
			(fur) => Object.assign(fur, { environment: zeros(6) }),
			/environment: got 6 entries, expected 0/,
		],
		[
			"a fin's environment",
			(fur) => Object.assign(fur.pelts[0]?.fin ?? {}, { environment: zeros(6) }),
			/fin.environment: got 6 entries, expected 0/,
		],
	])('refuses %s in one sentence', (_, breakIt, message) => {
		const fur = golden('ptm-6-curves');
		breakIt(fur);
		expect(() => parseFur(fur)).toThrow(message);
	});

	it('refuses curves in 1.x', () => {
		const { curves } = golden('ptm-6-curves');
		expect(() => parseFur({ ...golden(), curves })).toThrow(/curves: got 1 entries, expected 0/);
	});
});

describe('channels', () => {
	it('are those of the format', () => {
		const slots = [0, 1, 2, 3, 4, 5].map((i) => Object.values(channelOf(i)));
		expect(slots).toEqual([
			[0, 0],
			[0, 1],
			[0, 2],
			[1, 0],
			[1, 1],
			[0, 3],
		]);
		expect(alphaChannel(6)).toEqual({ plane: 1, channel: 2 });
		expect(alphaChannel(3)).toEqual({ plane: 0, channel: 3 });
	});
});
