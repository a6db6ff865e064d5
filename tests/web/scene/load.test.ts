import { expect, it } from 'vitest';
import { loadModel } from '../../../web/scene/load.ts';
import { golden, restoreNetwork, serve } from '../fur/loading/assets.ts';

restoreNetwork();

const { json, files } = golden();
const model = Buffer.from(JSON.stringify(json));
const whole = { ...files, 'model.gltf': new Uint8Array(model) };
const load = () => loadModel({ url: 'http://files.test/model.gltf' }, { size: 2048, layers: 256 });

it.each<[string, () => Response | Error]>([
	['cut short', () => new Response(model.subarray(0, 377))],
	['broken off', () => new TypeError('network error')],
	['refused by a busy server', () => new Response('', { status: 503 })],
])('a model.gltf is loaded at a second try: %s', async (_, answer) => {
	const requests = serve(whole, (file, n) => (file === 'model.gltf' && n === 0 ? answer() : undefined));
	expect((await load()).fur).toBeDefined();
	expect(requests).toEqual({ ...Object.fromEntries(Object.keys(whole).map((name) => [name, 1])), 'model.gltf': 2 });
});

it('a model.gltf that is cut short twice is told', async () => {
	const requests = serve(whole, (file) => (file === 'model.gltf' ? new Response(model.subarray(0, 377)) : undefined));
	await expect(load()).rejects.toThrow('model.gltf: expected glTF, but it is not even JSON (');
	expect(requests).toEqual({ 'model.gltf': 2 });
});

it('a model.gltf that is not there is not asked for again', async () => {
	const requests = serve(files);
	await expect(load()).rejects.toThrow('there is no such file');
	expect(requests).toEqual({ 'model.gltf': 1 });
});
