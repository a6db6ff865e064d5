import { describe, expect, it } from 'vitest';
import { formatAddress, parseAddress } from '../../../../web/demo/state/address.ts';
import type { View } from '../../../../web/demo/state/view.ts';

describe('a view and its address', () => {
	const views: View[] = [
		{ still: false, ui: true },
		{ still: true, ui: false },
		{ model: 'bunny', light: [0, 0.6, 0.8], camera: [30, -12.5, 1.25], shells: 48, fins: false, still: true, ui: true },
		{ env: 'sunset', planes: '128', still: true, ui: true },
		{ planes: 'auto', still: false, ui: true },
		{ model: 'fox', env: 'none', still: false, ui: true },
		{ model: 'https://example.org/a b/ä&c=d/', still: false, ui: true },
		{ model: 'bunny', crowd: 100, still: false, ui: true },
		{ preset: 'fox', method: 'eigen', split: { method: 'shadow-layers', share: 0.275 }, still: true, ui: true },
		{ lights: 8, length: 0.35, density: 1.75, colour: ['0a0b0c', 'ffeedd'], lang: 'zh', still: false, ui: true },
		{ split: { method: 'unlit', share: 0 }, fins: true, shells: 256, still: false, ui: true },
		{ wind: [0.35, 270], wet: 0.5, dirt: 1, turn: true, still: true, ui: true },
		{ wind: [0, 12.5], wet: 0, dirt: 0.01, turn: false, still: false, ui: true },
		{ model: 'fox', clip: 'Walk', time: 0.4, speed: 0.5, still: true, ui: true },
		{ clip: 'Läuft & springt, 50 %', time: 0, speed: 3, still: false, ui: true },
		{ time: 3599.125, still: false, ui: true },
		{ model: '../out/fox/', camera: [-179.9, 90, 0.01234], target: [0.5, -2, 0], still: false, ui: false },
	];

	it.each(views)('survive the round trip: %j', (view) => {
		expect(parseAddress(formatAddress(view))).toEqual({ view, problems: [] });
	});

	it('keep a light within half a unit of the third decimal', () => {
		for (let i = 0; i < 200; i++) {
			const [a, b] = [i * 2.399963, Math.acos(1 - (2 * i + 1) / 200)];
			const light: [number, number, number] = [Math.sin(b) * Math.cos(a), Math.cos(b), Math.sin(b) * Math.sin(a)];
			const back = parseAddress(formatAddress({ light, still: false, ui: true })).view.light ?? [0, 0, 0];
			for (const axis of [0, 1, 2]) expect(Math.abs((back[axis] ?? 0) - (light[axis] ?? 0))).toBeLessThan(1.5e-3);
		}
	});

	it('are readable: the example of the documentation', () => {
		const search =
			'?model=bunny&preset=fox&method=eigen&split=lengyel,0.5&light=0.303,0.808,0.505&lights=3&camera=30,12,1&target=0.6,-1,0.5&shells=48&fins=0&length=1.2&density=0.8&colour=33221a,e8b98a&planes=64&env=sunset&crowd=5&wind=0.4,90&wet=0.75&dirt=0.3&turn=1&clip=Walk&time=0.4&speed=0.5&still=1&ui=0&lang=zh';
		expect(formatAddress(parseAddress(search).view)).toBe(search);
	});

	it('have nothing to say where all is the page’s own', () => {
		expect(formatAddress({ still: false, ui: true })).toBe('');
	});
});

describe('reading an address', () => {
	it('normalises the light, in whatever way its numbers are written', () => {
		expect(parseAddress('?light=.0,3,-4e0').view.light).toEqual([0, 0.6, -0.8]);
	});

	it('takes colours in either case', () => {
		expect(parseAddress('?colour=AaBbCc,001122').view.colour).toEqual(['aabbcc', '001122']);
	});

	it('wraps the azimuth', () => {
		expect(parseAddress('?camera=370,0,1').view.camera).toEqual([10, 0, 1]);
		expect(parseAddress('?camera=-190,0,1').view.camera).toEqual([170, 0, 1]);
	});

	it('wraps the direction of the wind', () => {
		expect(parseAddress('?wind=.5,-90').view.wind).toEqual([0.5, 270]);
		expect(parseAddress('?wind=1,725').view.wind).toEqual([1, 5]);
	});

	it.each([
		'model=',
		'planes=',
		'planes=256',
		'env=',
		'env=mars',
		'env=Sunset',
		'env=toString',
		'light=',
		'light=1,2',
		'light=1,2,3,4',
		'light=0,0,0',
		'light=1,,2',
		'light=1,2,NaN',
		'light=Infinity,0,0',
		'light=1e999,0,0',
		'camera=1,2',
		'camera=0,91,1',
		'camera=0,0,0',
		'camera=0,0,11',
		'target=0,1',
		'target=0,2.1,0',
		'target=paw',
		'shells=0',
		'shells=257',
		'shells=1.5',
		'shells=-3',
		'shells=0x10',
		'crowd=0',
		'crowd=401',
		'crowd=ten',
		'preset=',
		'preset=../x',
		'method=',
		'method=PTM',
		'method=toString',
		'split=lengyel',
		'split=lengyel,',
		'split=lengyel,1.1',
		'split=lengyel,-0.1',
		'split=lengyel,0.5,1',
		'split=mars,0.5',
		'lights=0',
		'lights=9',
		'length=0.1',
		'length=1.6',
		'length=',
		'length=1,2',
		'density=2.01',
		'density=-1',
		'density=NaN',
		'exposure=',
		'exposure=0.2',
		'exposure=4.01',
		'colour=',
		'colour=red,blue',
		'colour=112233',
		'colour=11223,445566',
		'colour=112233,445566,778899',
		'wind=',
		'wind=1',
		'wind=1.1,90',
		'wind=-0.1,90',
		'wind=0.5,east',
		'wind=0.5,90,1',
		'wind=0.5,Infinity',
		'wet=',
		'wet=yes',
		'wet=1.01',
		'wet=-0.2',
		'dirt=2',
		'dirt=0.5,1',
		'turn=2',
		'turn=slow',
		'clip=',
		'time=',
		'time=-0.1',
		'time=3601',
		'time=now',
		'time=1,2',
		'speed=0',
		'speed=0.05',
		'speed=3.1',
		'speed=fast',
		'lang=fr',
		'fins=no',
		'still=yes',
		'ui=',
	])('ignores %s and says so', (query) => {
		const { view, problems } = parseAddress(`?${query}`);
		expect(view).toEqual({ still: false, ui: true });
		const [name, text] = query.split('=');
		expect(problems).toEqual([{ name, text, expected: expect.stringMatching(/^[a-z]+$/) }]);
	});

	it.each(['shadow=1', '__proto__=1', 'constructor=1', 'toString='])('ignores the unknown %s and says so', (query) => {
		const { view, problems } = parseAddress(query);
		expect(view).toEqual({ still: false, ui: true });
		expect(problems).toEqual([{ name: query.split('=')[0], text: query.split('=')[1] }]);
	});
});
