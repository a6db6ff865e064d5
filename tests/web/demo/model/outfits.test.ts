import { describe, expect, it, vi } from 'vitest';
import type { MenuEntry } from '../../../../web/demo/model/menu.ts';
import { type DressTarget, fineOutfits } from '../../../../web/demo/model/outfits.ts';
import type { View } from '../../../../web/demo/state/view.ts';

const { loadPelt } = vi.hoisted(() => ({ loadPelt: vi.fn(async ({ url }: { url: string }) => ({ url })) }));
vi.mock('../../../../web/scene/load.ts', async (original) => ({
	...(await original<typeof import('../../../../web/scene/load.ts')>()),
	loadPelt,
}));
vi.mock('../../../../web/demo/say/notice.ts', () => ({ notice: () => {} }));
vi.mock('../../../../web/demo/words/index.ts', () => ({ words: {} }));
vi.stubGlobal('document', { baseURI: 'https://example.org/' });

const menu: MenuEntry[] = [
	{ name: 'bunny', title: 'Bunny', preset: 'bunny' },
	{ name: 'torus', title: 'Torus', preset: 'paper' },
	{ name: 'pelt-bunny', title: 'Bunny', pelt: 'bunny', basis: 'ptm', tips: 0.5, gloss: 0.1 },
	{ name: 'fine-bunny', title: 'Bunny, fine', pelt: 'bunny', basis: 'ptm', fine: true, tips: 0.5, gloss: 0.1 },
];
const target = (name: string, withStates = false) =>
	({ withStates, entry: menu.find((entry) => entry.name === name), limits: {} }) as DressTarget;
const view = (part: Partial<View> = {}): View => ({ still: false, ui: true, ...part });

describe('outfits in finer planes', () => {
	it('are fetched when they are wanted, and known from then on', async () => {
		expect(await fineOutfits(view(), menu, target('bunny'), false)).toBeUndefined();
		expect(loadPelt).not.toHaveBeenCalled();
		const [own] = (await fineOutfits(view(), menu, target('bunny'), true)) ?? [];
		expect(own).toMatchObject({ method: 'ptm', tips: 1, gloss: undefined });
		expect(loadPelt.mock.calls[0]?.[0].url).toBe('https://example.org/models/fine-bunny/model.gltf');
		expect(await fineOutfits(view(), menu, target('bunny'), false)).toEqual([own]);
		expect(loadPelt).toHaveBeenCalledOnce();
	});

	it('are those of what the model wears, in all that is shown side by side', async () => {
		const worn = view({ preset: 'bunny', method: 'lengyel', split: { method: 'ptm', share: 0.5 } });
		const outfits = await fineOutfits(worn, menu, target('torus'), true);
		expect(outfits).toMatchObject([
			{ method: 'lengyel', tips: 0.5, gloss: 0.1 },
			{ method: 'ptm', tips: 0.5, gloss: 0.1 },
		]);
	});

	it.each<[string, View, DressTarget]>([
		['a fur without them', view(), target('torus')],
		['a model of the visitor’s own', view(), target('')],
		['wet or dirty fur', view(), target('bunny', true)],
		['eigen curves', view({ split: { method: 'eigen', share: 0.5 } }), target('bunny')],
		['a crowd', view({ crowd: 5 }), target('bunny')],
	])('are not there for %s', async (_, shown, worn) => {
		expect(await fineOutfits(shown, menu, worn, true)).toBeUndefined();
	});
});
