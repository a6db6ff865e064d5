import { describe, expect, it, vi } from 'vitest';
import type { View } from '../../web/demo/address.ts';
import type { MenuEntry } from '../../web/demo/models.ts';
import { fineOutfits, type Wearer } from '../../web/demo/outfits.ts';

const { loadPelt } = vi.hoisted(() => ({ loadPelt: vi.fn(async ({ url }: { url: string }) => ({ url })) }));
vi.mock('../../web/demo/models.ts', async (original) => ({
	...(await original<typeof import('../../web/demo/models.ts')>()),
	loadPelt,
}));
vi.mock('../../web/demo/notice.ts', () => ({ notice: () => {} }));
vi.mock('../../web/demo/words/index.ts', () => ({ words: {} }));
vi.stubGlobal('document', { baseURI: 'https://example.org/' });

const menu: MenuEntry[] = [
	{ name: 'bunny', title: 'Bunny', preset: 'bunny' },
	{ name: 'torus', title: 'Torus', preset: 'paper' },
	{ name: 'pelt-bunny', title: 'Bunny', pelt: 'bunny', basis: 'ptm', tips: 0.5, gloss: 0.1 },
	{ name: 'fine-bunny', title: 'Bunny, fine', pelt: 'bunny', basis: 'ptm', fine: true, tips: 0.5, gloss: 0.1 },
];
const wearer = (name: string, soiled = false) =>
	({ soiled, entry: menu.find((entry) => entry.name === name), limits: {} }) as Wearer;
const view = (part: Partial<View> = {}): View => ({ still: false, ui: true, ...part });

describe('outfits in finer planes', () => {
	it('are fetched when they are wanted, and known from then on', async () => {
		expect(await fineOutfits(view(), menu, wearer('bunny'), false)).toBeUndefined();
		expect(loadPelt).not.toHaveBeenCalled();
		const [own] = (await fineOutfits(view(), menu, wearer('bunny'), true)) ?? [];
		expect(own).toMatchObject({ method: 'ptm', tips: 1, gloss: undefined });
		expect(loadPelt.mock.calls[0]?.[0].url).toBe('https://example.org/models/fine-bunny/model.gltf');
		expect(await fineOutfits(view(), menu, wearer('bunny'), false)).toEqual([own]);
		expect(loadPelt).toHaveBeenCalledOnce();
	});

	it('are those of what the model wears, in all that is shown side by side', async () => {
		const worn = view({ preset: 'bunny', method: 'lengyel', split: { method: 'ptm', share: 0.5 } });
		const outfits = await fineOutfits(worn, menu, wearer('torus'), true);
		expect(outfits).toMatchObject([
			{ method: 'lengyel', tips: 0.5, gloss: 0.1 },
			{ method: 'ptm', tips: 0.5, gloss: 0.1 },
		]);
	});

	it.each<[string, View, Wearer]>([
		['a fur without them', view(), wearer('torus')],
		['a model of the visitor’s own', view(), wearer('')],
		['wet or dirty fur', view(), wearer('bunny', true)],
		['eigen curves', view({ split: { method: 'eigen', share: 0.5 } }), wearer('bunny')],
		['a crowd', view({ crowd: 5 }), wearer('bunny')],
	])('are not there for %s', async (_, shown, worn) => {
		expect(await fineOutfits(shown, menu, worn, true)).toBeUndefined();
	});
});
