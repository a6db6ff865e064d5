import { afterEach, expect, it, vi } from 'vitest';
import { findPelt, gltfAt } from '../../../web/view/subject.ts';

const MODEL = 'https://a.test/some/models/bunny/model.gltf';

afterEach(() => vi.unstubAllGlobals());

it.each([
	['models/bunny/model.gltf', 'https://a.test/x/models/bunny/model.gltf'],
	['models/bunny', 'https://a.test/x/models/bunny/model.gltf'],
	['../bunny/?v=2', 'https://a.test/bunny/model.gltf?v=2'],
	['https://b.test/fox.GLB', 'https://b.test/fox.GLB'],
])('%s is %s', (address, expected) => {
	expect(gltfAt(address, 'https://a.test/x/page.html')).toBe(expected);
});

it('a preset is a name of the list beside the model, or an address', async () => {
	const list = [
		{ name: 'bunny' },
		{ name: 'fine-fox', pelt: 'fox', basis: 'ptm', fine: true },
		{ name: 'pelt-fox-eigen', pelt: 'fox', basis: 'eigen' },
		{ name: 'pelt-fox', pelt: 'fox', basis: 'ptm', gloss: 0.1 },
		{ name: 'pelt-mole', pelt: 'mole', basis: 'ptm', tips: 0 },
	];
	const asked: string[] = [];
	vi.stubGlobal('fetch', async (url: URL) => {
		asked.push(url.href);
		return Response.json(list);
	});
	const pelt = 'https://a.test/some/models/pelt-fox/model.gltf';
	expect(await findPelt('fox', MODEL, MODEL)).toEqual({ url: pelt, gloss: 0.1 });
	expect(await findPelt('mole', MODEL, MODEL)).toMatchObject({ tips: 0 });
	expect(asked).toEqual(Array(2).fill('https://a.test/some/models/models.json'));
	expect(await findPelt('furs/fox', MODEL, 'https://b.test/')).toEqual({ url: 'https://b.test/furs/fox/model.gltf' });
	await expect(findPelt('cat', MODEL, MODEL)).rejects.toThrow('got cat, expected one of fox, mole');
	vi.stubGlobal('fetch', async () => new Response('', { status: 404 }));
	await expect(findPelt('fox', MODEL, MODEL)).rejects.toThrow('models.json: got status 404');
});
