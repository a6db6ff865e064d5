import { describe, expect, it, vi } from 'vitest';
import { Store } from '../../../../web/demo/state/store.ts';
import { FIRST_VIEW } from '../../../../web/demo/state/view.ts';

describe('the store', () => {
	it('changes the values that it is given, and tells which', () => {
		const store = new Store({ ...FIRST_VIEW, wet: 0.5, split: { method: 'unlit', share: 0.5 } });
		const listener = vi.fn();
		store.subscribe(listener);
		store.change({ wet: undefined, dirt: 0.25, still: false });
		expect(store.get()).toEqual({ ...FIRST_VIEW, dirt: 0.25, split: { method: 'unlit', share: 0.5 } });
		expect(listener.mock.calls).toEqual([[store.get(), ['wet', 'dirt']]]);
	});

	it('keeps silent where nothing changes, in lists and objects too', () => {
		const store = new Store({ ...FIRST_VIEW, wind: [0.4, 90], split: { method: 'unlit', share: 0.5 } });
		const before = store.get();
		const listener = vi.fn();
		store.subscribe(listener);
		store.change({ wind: [0.4, 90], split: { method: 'unlit', share: 0.5 }, crowd: undefined });
		expect(listener).not.toHaveBeenCalled();
		expect(store.get()).toBe(before);
		store.change({ wind: [0.4, 91] });
		store.change({ split: { method: 'unlit', share: 0.25 } });
		expect(listener).toHaveBeenCalledTimes(2);
	});

	it('gives out views that stay as they are', () => {
		const asked = { ...FIRST_VIEW, crowd: 3 };
		const store = new Store(asked);
		const view = store.get();
		asked.crowd = 4;
		store.change({ crowd: 5 });
		expect(view.crowd).toBe(3);
		expect(() => Object.assign(store.get(), { crowd: 6 })).toThrow(TypeError);
	});

	it('tells nothing to a listener that has left, and the others all the same', () => {
		const store = new Store(FIRST_VIEW);
		const [first, second] = [vi.fn(), vi.fn()];
		const leave = store.subscribe(first);
		store.subscribe(second);
		leave();
		store.change({ dirt: 1 });
		expect([first.mock.calls.length, second.mock.calls.length]).toEqual([0, 1]);
	});
});
