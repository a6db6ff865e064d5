import { LoadingManager } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { describe, expect, it, vi } from 'vitest';
import { FurLoaderPlugin } from '../../../../web/fur/FurLoaderPlugin.ts';
import { type Answer, golden, type Json, load, refusal, restoreNetwork, serve } from './assets.ts';

restoreNetwork();

const { json, files } = golden();
const bin = files['model.bin'] as Uint8Array;
const bytes = (file: string, end: number) => new Response(files[file]?.slice(0, end));

/** Answer to the first `times` requests of a file. */
const only =
	(wanted: string, times: number, answer: () => Response | Error): Answer =>
	(file, n) =>
		file === wanted && n < times ? answer() : undefined;

describe('a download that breaks off', () => {
	it.each<[string, Answer]>([
		['model.bin', only('model.bin', 1, () => bytes('model.bin', 377))],
		['model.bin', only('model.bin', 1, () => new TypeError('network error'))],
		['model.bin', only('model.bin', 1, () => new Response('', { status: 503 }))],
		['plane0.png', only('plane0.png', 1, () => bytes('plane0.png', 200))],
		['fin1.png', only('fin1.png', 1, () => new TypeError('network error'))],
	])('is tried once more: %s', async (file, answer) => {
		const requests = serve(files, answer);
		const manager = new LoadingManager();
		const failed = vi.fn();
		const done = vi.fn();
		Object.assign(manager, { onError: failed, onLoad: done });
		expect(await refusal(json, { manager })).toBe('loaded');
		expect(requests).toEqual({ ...Object.fromEntries(Object.keys(files).map((name) => [name, 1])), [file]: 2 });
		expect(failed).not.toHaveBeenCalled();
		await vi.waitFor(() => expect(done).toHaveBeenCalled());
	});

	it.each<[string, string, () => Response | Error, string]>([
		['model.bin', 'short', () => bytes('model.bin', 377), `model.bin: got 377 bytes, expected ${bin.length}`],
		['model.bin', 'off', () => new TypeError('cut'), 'model.bin: could not be loaded (cut)'],
		['plane1.png', 'off', () => new TypeError('cut'), 'plane1.png: could not be loaded (cut)'],
		[
			'plane1.png',
			'short',
			() => bytes('plane1.png', 200),
			'plane1.png: not a readable PNG (got 0 bytes of data, expected 1056)',
		],
	])('twice is told: %s %s', async (file, _, answer, sentence) => {
		const requests = serve(files, only(file, 2, answer));
		expect(await refusal(json)).toBe(sentence);
		expect(requests[file]).toBe(2);
	});

	it('is not tried again where the server answers that there is none', async () => {
		const { 'plane1.png': _, ...others } = files;
		const requests = serve(others);
		const manager = new LoadingManager();
		manager.onError = vi.fn();
		expect(await refusal(json, { manager })).toMatch(/^plane1\.png: could not be loaded \(.*404/);
		expect(requests['plane1.png']).toBe(1);
		expect(manager.onError).toHaveBeenCalledExactlyOnceWith('http://files.test/plane1.png');
	});

	it('is not tried at a broken address, however often it is asked for', async () => {
		const requests = serve(files);
		const copy = structuredClone(json);
		copy.buffers[0].uri = 'http://[';
		for (let i = 0; i < 2; i++) expect(await refusal(copy)).toMatch(/^http:\/\/\[: could not be loaded \(/);
		expect(requests).toEqual({});
	});

	it('is not tried again after the app has aborted it', async () => {
		const manager = new LoadingManager();
		const requests = serve(files, (file) => {
			if (file === 'model.bin') manager.abort();
			return file === 'model.bin' ? new DOMException('aborted by the app', 'AbortError') : undefined;
		});
		expect(await refusal(json, { manager })).toBe('model.bin: could not be loaded (aborted by the app)');
		expect(requests['model.bin']).toBe(1);
	});
});

it('a .glb cut short is told as that', async () => {
	const { uri: _, ...buffer } = json.buffers[0];
	const words = Buffer.from(JSON.stringify({ ...json, buffers: [buffer] }));
	const text = Buffer.concat([words, Buffer.alloc(-words.length & 3, ' ')]);
	const head = (...values: number[]) => Buffer.from(new Uint32Array(values).buffer);
	const size = 28 + text.length + bin.length;
	const glb = Buffer.concat([
		head(0x46546c67, 2, size, text.length, 0x4e4f534a),
		text,
		head(bin.length, 0x4e4942),
		bin.subarray(0, 1000),
	]);
	const loader = new GLTFLoader().register((parser) => new FurLoaderPlugin(parser));
	await expect(loader.parseAsync(new Uint8Array(glb).buffer, '')).rejects.toThrow(
		`buffer 0: got 1000 bytes, expected ${bin.length}`,
	);
});

/** The asset with an attribute of the mesh in floats, one of which is another. */
function withFloats(mesh: number, semantic: string, size: number, value: number): { json: Json; bin: Uint8Array } {
	const copy = structuredClone(json);
	const { attributes } = copy.meshes[mesh].primitives[0];
	const { count } = copy.accessors[attributes[semantic]];
	const floats = new Float32Array(count * size).fill(0.5);
	floats[7] = value;
	const bounds = { min: new Array(size).fill(0), max: new Array(size).fill(1) };
	attributes[semantic] = copy.accessors.length;
	copy.accessors.push({
		bufferView: copy.bufferViews.length,
		componentType: 5126,
		count,
		type: `VEC${size}`,
		...bounds,
	});
	copy.bufferViews.push({ buffer: 0, byteOffset: bin.length, byteLength: floats.byteLength });
	copy.buffers[0].byteLength += floats.byteLength;
	return { json: copy, bin: new Uint8Array(Buffer.concat([bin, new Uint8Array(floats.buffer)])) };
}

describe('a number that is not finite', () => {
	it.each<[number, string, number, number, string]>([
		[0, 'POSITION', 3, Number.NaN, 'skin: got NaN in the position of vertex 2'],
		[1, 'POSITION', 3, Number.NEGATIVE_INFINITY, 'shells: got -Infinity in the position of vertex 2'],
		[1, 'NORMAL', 3, Number.NaN, 'shells: got NaN in the normal of vertex 2'],
		[1, 'TANGENT', 4, Number.NaN, 'shells: got NaN in the tangent of vertex 1'],
		[2, 'TEXCOORD_0', 2, Number.POSITIVE_INFINITY, 'fins: got Infinity in the uv of vertex 3'],
	])('is refused in mesh %i, %s', async (mesh, semantic, size, value, sentence) => {
		const bad = withFloats(mesh, semantic, size, value);
		serve({ ...files, 'model.bin': bad.bin });
		expect(await refusal(bad.json)).toBe(`FUR_ptm_shells/${sentence}, expected a finite number`);
		const good = withFloats(mesh, semantic, size, 0.25);
		serve({ ...files, 'model.bin': good.bin });
		expect(await refusal(good.json)).toBe('loaded');
	});
});

it('an index beyond the vertices is refused', async () => {
	const copy = structuredClone(json);
	const { attributes } = copy.meshes[1].primitives[0];
	for (const accessor of Object.values<number>(attributes)) copy.accessors[accessor].count = 200;
	serve(files);
	expect(await refusal(copy)).toMatch(/^FUR_ptm_shells\/shells: got vertex \d+, expected less than 200$/);
});

it('without our extension a model loads as ever, its faults included', async () => {
	const { extensions: _, ...plain } = structuredClone(json);
	const requests = serve(files);
	expect((await load(plain)).userData.fur).toBeUndefined();
	expect(requests).toEqual({ 'model.bin': 1 });
	plain.accessors[0].count = 1e6;
	expect(await refusal(plain)).toContain('Invalid typed array length');
});

it('a model is trusted where the app asks for it', async () => {
	const odd = structuredClone(json);
	odd.extensions.FUR_ptm_shells.pelts[0].scale = 'none';
	serve(files);
	expect(await refusal(odd)).toMatch(/^FUR_ptm_shells\/pelts\/0\/scale: /);
	serve(files);
	expect(await refusal(json, { check: false })).toBe('loaded');
	serve(files);
	expect(await refusal(odd, { check: false })).not.toMatch(/FUR_ptm_shells\/pelts/);
});
