import { expect, it, vi } from 'vitest';
import { adjust } from '../../../../web/demo/model/adjust.ts';
import type { MenuEntry } from '../../../../web/demo/model/menu.ts';
import { FIRST_VIEW, type View } from '../../../../web/demo/state/view.ts';
import { en } from '../../../../web/demo/words/en.ts';

vi.mock('../../../../web/demo/words/index.ts', () => ({ words: {} }));

const menu: MenuEntry[] = [
	{ name: 'bunny', title: 'Bunny', preset: 'bunny' },
	{ name: 'pelt-bunny', title: 'Bunny', pelt: 'bunny', basis: 'ptm' },
	{ name: 'pelt-fox', title: 'Fox', pelt: 'fox', basis: 'ptm' },
	{ name: 'pelt-fox-eigen', title: 'Fox, eigen', pelt: 'fox', basis: 'eigen' },
];

it.each<[string, Partial<View>, Partial<View>, string[]]>([
	['all of it', { preset: 'fox', method: 'eigen', crowd: 5 }, { preset: 'fox', method: 'eigen', crowd: 5 }, []],
	['no preset of another name', { preset: 'cat', wet: 1 }, { wet: 1 }, [en.wrongPreset('cat', 'bunny, fox')]],
	['no eigen curves where there are none', { method: 'eigen' }, {}, [en.noEigenHere]],
	[
		'no eigen curves beside another method either',
		{ method: 'unlit', split: { method: 'eigen', share: 0.5 } },
		{ method: 'unlit' },
		[en.noEigenHere],
	],
	['a crowd without rivals', { crowd: 2, method: 'lengyel' }, { crowd: 2 }, [en.rivalLeftOut]],
	[
		'a crowd in one picture',
		{ preset: 'fox', crowd: 2, method: 'eigen', split: { method: 'ptm', share: 0.5 } },
		{ preset: 'fox', crowd: 2, method: 'eigen' },
		[en.rivalLeftOut],
	],
])('leaves %s', (_, asked, left, sentences) => {
	const before: View = Object.freeze({ ...FIRST_VIEW, ...asked });
	const { view, reasons } = adjust(before, menu[0], menu);
	expect(view).toEqual({ ...FIRST_VIEW, ...left });
	expect(reasons.map((reason) => reason(en))).toEqual(sentences);
});

it('leaves no crowd of a model that stands alone', () => {
	const { view, reasons } = adjust({ ...FIRST_VIEW, crowd: 5 }, menu[0], menu, true);
	expect(view).toEqual(FIRST_VIEW);
	expect(reasons.map((reason) => reason(en))).toEqual([en.standsAlone]);
});
