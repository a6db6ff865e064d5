import { describe, expect, it } from 'vitest';
import { Calm } from '../../../web/learn/calm.ts';

/** Media query for less motion that a test answers. */
class Preference extends EventTarget {
	constructor(public matches: boolean) {
		super();
	}

	change(matches: boolean) {
		this.matches = matches;
		this.dispatchEvent(new Event('change'));
	}
}

describe('calm', () => {
	it('follows the preference when it changes, and the reader', () => {
		const preference = new Preference(false);
		const calm = new Calm(false, preference);
		const heard: boolean[] = [];
		calm.listen((on) => heard.push(on));
		preference.change(true);
		calm.on = false;
		calm.on = false;
		calm.on = true;
		preference.change(false);
		expect(heard).toEqual([false, true, false, true, false]);
	});

	it('is on from the first where less motion is preferred', () => {
		expect(new Calm(false, new Preference(true)).on).toBe(true);
	});

	it('cannot be left where it is always on', () => {
		const preference = new Preference(false);
		const calm = new Calm(true, preference);
		calm.on = false;
		preference.change(false);
		expect(calm.on).toBe(true);
	});
});
