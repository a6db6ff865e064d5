import { Group } from 'three';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { Exhibit } from '../../../../web/demo/model/exhibit.ts';
import type { Progress } from '../../../../web/demo/say/progress.ts';
import type { Picture } from '../../../../web/demo/stage/picture.ts';
import { Store } from '../../../../web/demo/state/store.ts';
import type { View } from '../../../../web/demo/state/view.ts';

const { notice, withdraw } = vi.hoisted(() => ({ notice: vi.fn(), withdraw: vi.fn() }));
vi.mock('../../../../web/demo/say/notice.ts', () => ({ notice, withdraw }));
vi.mock('../../../../web/page/element.ts', () => ({ setState: () => {} }));
vi.mock('../../../../web/demo/words/index.ts', async () => {
	const { en } = await import('../../../../web/demo/words/en.ts');
	return { language: 'en', words: en };
});

beforeEach(() => vi.clearAllMocks());

/** With a model on show whose fur knows wet states. */
function exhibit(view: View) {
	const fur = { states: { wet: true, dirt: false }, asset: {}, shells: {} };
	const stage = {
		...{ model: { fur }, scene: new Group(), limits: {}, gl: { isContextLost: () => false } },
		...{ setCrowd() {}, moveBody() {}, renderer: { extensions: { has: () => false } } },
	};
	const picture = {
		...{ stage, guides: new Group(), canvas: { dataset: {} }, calm: true, frames: { hold: async () => {} } },
		...{ updateLight() {}, fit() {}, request() {}, reportTextureMemory() {}, drawn: async () => {}, columnOf: () => 1 },
	};
	const store = new Store(view);
	const shown = new Exhibit(picture as unknown as Picture, store, {} as Progress);
	for (const name of ['show', 'setSplit', 'style'] as const) vi.spyOn(shown.looks, name).mockImplementation(() => {});
	const load = vi.spyOn(shown.looks, 'loadStates').mockResolvedValue();
	/** Puts it on, with all that comes of it. */
	const styled = async () => {
		await shown.style();
		await new Promise((resolve) => setTimeout(resolve));
	};
	return { store, load, styled };
}

const view = (): View => ({ ui: true, still: false, wet: 0.5, planes: '64' });

describe('states of the fur on show', () => {
	it('are asked for once, when fur is to be wet', async () => {
		const dry = exhibit({ ...view(), wet: undefined });
		await dry.styled();
		expect(dry.load).not.toHaveBeenCalled();
		const { load, styled } = exhibit(view());
		for (let i = 0; i < 3; i++) await styled();
		expect(load).toHaveBeenCalledOnce();
	});

	it('are asked for anew after that has failed, which is said, one word at a time', async () => {
		const { store, load, styled } = exhibit(view());
		load.mockRejectedValueOnce(new Error('wet-plane0.png: could not be loaded'));
		await styled();
		expect(notice.mock.calls).toEqual([[expect.stringContaining('wet-plane0.png'), 'error', 'states']]);
		expect(store.get().wet).toBeUndefined();
		await styled();
		expect(load, 'nothing is to be wet').toHaveBeenCalledOnce();
		expect(withdraw).not.toHaveBeenCalled();
		store.change({ wet: 0.7 });
		for (let i = 0; i < 2; i++) await styled();
		expect([load.mock.calls.length, store.get().wet]).toEqual([2, 0.7]);
		expect(withdraw).toHaveBeenCalledWith('states');
	});
});
