import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { ATTRIBUTES, format, parseCamera, parseLight } from '../../../web/view/attributes.ts';

describe('attributes', () => {
	it.each([
		['-0.9,0.45,0.2', [-0.9, 0.45, 0.2]],
		[' 1 , 2e-1 ,0', [1, 0.2, 0]],
		['0,0,0', undefined],
		['1,2', undefined],
		['1,2,3,4', undefined],
		['1,,3', undefined],
		['north', undefined],
		['1,2,Infinity', undefined],
		['', undefined],
		[null, undefined],
	])('light=%j is %j', (text, expected) => {
		expect(parseLight(text)).toEqual(expected);
	});

	it.each([
		['20,38,0.95', [20, 38, 0.95]],
		['400,95,9', [400, 89.9, 4]],
		['0,-95,0', [0, -89.9, 0.25]],
		['0,8', undefined],
	])('camera=%j is %j', (text, expected) => {
		expect(parseCamera(text)).toEqual(expected);
	});

	it('are written to three places, without a negative zero, and read back', () => {
		expect(format([-0.00001, 0.12345, 20])).toBe('0,0.123,20');
		expect(parseCamera(format([12.3456, -7, 1.5]))).toEqual([12.346, -7, 1.5]);
	});
});

describe('the docs of the tag', () => {
	const guide = readFileSync(new URL('../../../web/docs/fur-view.md', import.meta.url), 'utf8');
	const types = readFileSync(new URL('../../../web/view/view.d.ts', import.meta.url), 'utf8');

	it('have all attributes, in order', () => {
		const [, table = ''] = /<!-- attributes -->([\s\S]*)<!-- \/attributes -->/.exec(guide) ?? [];
		expect([...table.matchAll(/^\| `([\w-]+)`/gm)].map(([, name]) => name)).toEqual([...ATTRIBUTES]);
	});

	it('name what the types have', () => {
		const [, events = ''] = /interface FurViewEventMap[^{]*\{([^}]*(?:\{[^}]*\}[^}]*)*)\}/.exec(types) ?? [];
		for (const [, name] of events.matchAll(/^\t(\w+):/gm)) expect(guide).toContain(`\`${name}\``);
		// Properties that any element has.
		for (const name of ATTRIBUTES.filter((name) => name !== 'lang' && name !== 'aria-label'))
			expect(types).toMatch(new RegExp(`^\\t(get )?${name}(\\(\\))?: `, 'm'));
	});
});
