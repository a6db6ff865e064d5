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

it.each(['Failed to fetch', 'NetworkError when attempting to fetch resource.', 'Load failed'])(
	'a connection that breaks off twice is told: %s',
	async (said) => {
		const requests = serve(whole, () => new TypeError(said));
		await expect(load()).rejects.toThrow(
			`files do not arrive: there is no connection, or their host does not let this page read them (${said})`,
		);
		expect(requests).toEqual({ 'model.gltf': 2 });
	},
);

it('a model that is known to be sound is checked where it fails', async () => {
	const sound = () => loadModel({ url: 'http://files.test/model.gltf', sound: true }, { size: 2048, layers: 256 });
	const requests = serve(whole);
	expect((await sound()).fur).toBeDefined();
	expect(requests['model.gltf']).toBe(1);
	serve({ ...whole, 'model.gltf': new TextEncoder().encode('{"asset": {"version": "2.0"}}') });
	await expect(sound()).rejects.toThrow('model.gltf: got a scene without a mesh, expected one');
	const spoilt = structuredClone(json);
	spoilt.extensions.FUR_ptm_shells.layers = 'many';
	serve({ ...whole, 'model.gltf': new Uint8Array(Buffer.from(JSON.stringify(spoilt))) });
	await expect(sound()).rejects.toThrow('FUR_ptm_shells/layers');
});

it('a model.gltf that is not there is not asked for again', async () => {
	const requests = serve(files);
	await expect(load()).rejects.toThrow('there is no such file');
	expect(requests).toEqual({ 'model.gltf': 1 });
});
