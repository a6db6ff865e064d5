import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { formatAddress, parseAddress } from '../../../../web/demo/state/address.ts';
import type { Control, Shown } from '../../../../web/demo/state/controls.ts';
import { withAddressTable } from '../../../../web/demo/state/docs.ts';
import { NAMES, parameters } from '../../../../web/demo/state/parameters.ts';
import { FIRST_VIEW, type View } from '../../../../web/demo/state/view.ts';

const shown: Shown = {
	...{ model: 'bunny', env: 'none', shells: 24, colour: ['102030', 'a0b0c0'] },
	...{ clip: 'Walk', time: 0.4, duration: 3600 },
};

/** Values that a control can be set to. */
function settings(control: Control): unknown[] {
	// A whole turn is none.
	if (control.kind === 'slider') return control.range.map((value) => (value === 360 ? 359 : value));
	if (control.kind === 'toggle') return [true, false];
	if (control.kind === 'choice') return [...control.names];
	return control.kind === 'colour' ? ['#0a0b0c'] : ['fox'];
}

const cases = NAMES.flatMap((name) => (parameters[name].controls ?? []).map((control) => ({ name, control })));

describe('the table of parameters', () => {
	it.each(NAMES)('%s has an example that the address reads and writes as it stands', (name) => {
		const query = `?${name}=${parameters[name].doc[0]}`;
		const { view, problems } = parseAddress(query);
		expect(problems).toEqual([]);
		const again = parseAddress(formatAddress(view));
		expect(again.problems).toEqual([]);
		expect(formatAddress(again.view)).toBe(formatAddress(view));
	});

	it.each(cases)('$control.label sets $name alone, to what the address reads', ({ name, control }) => {
		for (const value of settings(control)) {
			const patch = control.set(value as never, FIRST_VIEW, shown);
			expect(Object.keys(patch)).toEqual([name]);
			const view: View = { ...FIRST_VIEW, ...patch };
			expect(parseAddress(formatAddress(view))).toEqual({ view, problems: [] });
		}
	});

	it.each(cases.filter(({ control }) => !['model', 'environment', 'shells'].includes(control.label)))(
		'$control.label shows what it was set to',
		({ control }) => {
			for (const value of settings(control)) {
				const view: View = { ...FIRST_VIEW, ...control.set(value as never, FIRST_VIEW, shown) };
				expect(control.get(view, shown)).toBe(value);
			}
		},
	);

	it('has sliders with steps that fill their range', () => {
		for (const { control } of cases) {
			if (control.kind !== 'slider') continue;
			const [min, max] = control.range;
			const steps = (max - min) / control.step;
			expect(steps, control.label).toBeCloseTo(Math.round(steps), 6);
			expect(steps, control.label).toBeGreaterThan(1);
		}
	});

	it('leaves values as at first out of the view', () => {
		for (const { name, control } of cases)
			if (!['model', 'automatic', 'shells', 'root', 'tip', 'clip', 'time'].includes(control.label))
				expect(control.set(control.get(FIRST_VIEW, shown) as never, FIRST_VIEW, shown)[name], name).toBeUndefined();
	});

	it('is the table of the docs', () => {
		const page = readFileSync(new URL('../../../../web/docs/address.md', import.meta.url), 'utf8');
		expect(page, 'run npm run check -- --write').toBe(withAddressTable(page));
	});
});
