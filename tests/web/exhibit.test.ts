import { Group } from 'three';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { View } from '../../web/demo/address.ts';
import { Exhibit } from '../../web/demo/exhibit.ts';
import type { Picture } from '../../web/demo/picture.ts';
import type { Progress } from '../../web/demo/progress.ts';

const { notice, withdraw } = vi.hoisted(() => ({ notice: vi.fn(), withdraw: vi.fn() }));
vi.mock('../../web/demo/notice.ts', () => ({ notice, withdraw }));
vi.mock('../../web/page/element.ts', () => ({ setState: () => {} }));
vi.mock('../../web/demo/words/index.ts', async () => {
	const { en } = await import('../../web/demo/words/en.ts');
	return { language: 'en', words: en };
});

beforeEach(() => vi.clearAllMocks());

/** With a model on show whose fur knows wet states. */
function exhibit(view: View) {
	const fur = { hasStates: { wet: true, dirt: false } };
	const stage = {
		...{ model: { fur }, scene: new Group(), limits: {}, gl: { isContextLost: () => false } },
		...{ gather() {}, place() {} },
	};
	const picture = {
		...{ stage, guides: new Group(), canvas: { dataset: {} }, calm: true },
		...{ aim() {}, fit() {}, request() {}, drawn: async () => {} },
	};
	const shown = new Exhibit(picture as unknown as Picture, view, {} as Progress);
	for (const name of ['wear', 'cut', 'style'] as const) vi.spyOn(shown.looks, name).mockImplementation(() => {});
	const load = vi.spyOn(shown.looks, 'loadStates').mockResolvedValue();
	/** Puts it on, and waits for all that comes of it. */
	const styled = async () => {
		shown.style();
		await vi.waitFor(() => expect(load.mock.settledResults.every(({ type }) => type !== 'incomplete')).toBe(true));
		await new Promise((resolve) => setTimeout(resolve));
	};
	return { shown, load, styled };
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
		const asked = view();
		const { load, styled } = exhibit(asked);
		load.mockRejectedValueOnce(new Error('wet-plane0.png: could not be loaded'));
		await styled();
		expect(notice.mock.calls).toEqual([[expect.stringContaining('wet-plane0.png'), 'error', 'states']]);
		expect(asked.wet).toBeUndefined();
		await styled();
		expect(load, 'nothing is to be wet').toHaveBeenCalledOnce();
		expect(withdraw).not.toHaveBeenCalled();
		asked.wet = 0.7;
		for (let i = 0; i < 2; i++) await styled();
		expect([load.mock.calls.length, asked.wet]).toEqual([2, 0.7]);
		expect(withdraw).toHaveBeenCalledWith('states');
	});
});
