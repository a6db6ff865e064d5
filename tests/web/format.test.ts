import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { alphaChannel, channelOf, type FurAsset, parseFur } from '../../web/fur/format.ts';

const golden = (): FurAsset & Record<string, unknown> =>
	JSON.parse(readFileSync(new URL('../golden/ptm-6/model.gltf', import.meta.url), 'utf8')).extensions.FUR_ptm_shells;

describe('parseFur', () => {
	it.each(['ptm-6', 'eigen-6', 'eigen-3'])('takes what the baker writes: %s', (name) => {
		const gltf = JSON.parse(readFileSync(new URL(`../golden/${name}/model.gltf`, import.meta.url), 'utf8'));
		expect(parseFur(gltf.extensions.FUR_ptm_shells)).toEqual(gltf.extensions.FUR_ptm_shells);
	});

	it('leaves a newer major version alone and takes a newer minor one', () => {
		expect(parseFur({ version: '2.0', whatever: 1 })).toBeUndefined();
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
		['an environment too short', (fur) => fur.environment.pop(), /environment/],
		['null', () => undefined, /FUR_ptm_shells/],
	])('refuses %s in one sentence', (what, breakIt, message) => {
		const fur = golden();
		breakIt(fur);
		expect(() => parseFur(what === 'null' ? null : fur)).toThrow(message);
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
