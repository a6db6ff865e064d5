import { readdirSync, readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import type { OwnModel, Refusal } from '../../../../web/demo/open/openModel.ts';
import { openModel } from '../../../../web/demo/open/openModel.ts';
import { triangle, zipped } from './zips.ts';

const folder = new URL('../../../../public/models/torus-512/', import.meta.url);
const baked = Object.fromEntries(
	readdirSync(folder).map((name) => [name, new Uint8Array(readFileSync(new URL(name, folder)))]),
);
const bytes = (part: string | Uint8Array) => (typeof part === 'string' ? part : new Uint8Array(part));
const file = (name: string, part: string | Uint8Array) => new File([bytes(part)], name);
const gltf = (change: object) => JSON.stringify({ asset: { version: '2.0' }, ...change });

const opened = (...files: File[]) => openModel({ entries: [], files }, 'en');
const reason = async (...files: File[]) => ((await opened(...files)) as Refusal).reason;

/** A folder as a browser hands it over: never more than a hundred children at once. */
function entry(path: string, children: Record<string, string | Uint8Array>): FileSystemEntry {
	const isHere = (key: string) => key.startsWith(`${path}/`);
	const name = path.split('/').at(-1) ?? '';
	const fullPath = `/${path}`;
	if (path in children) {
		const part = children[path] as string;
		return {
			isFile: true,
			isDirectory: false,
			name,
			fullPath,
			file: (done: (file: File) => void) => done(file(name, part)),
		} as never;
	}
	const names = new Set(
		Object.keys(children)
			.filter(isHere)
			.map((key) => key.slice(path.length + 1).split('/')[0]),
	);
	const left = [...names].map((child) => entry(`${path}/${child}`, children));
	const readEntries = (done: (batch: FileSystemEntry[]) => void) => setTimeout(() => done(left.splice(0, 100)));
	return { isFile: false, isDirectory: true, name, fullPath, createReader: () => ({ readEntries }) } as never;
}
const under = (top: string, files: Record<string, string | Uint8Array>) =>
	Object.fromEntries(Object.entries(files).map(([name, part]) => [`${top}/${name}`, part]));

describe('what opens', () => {
	it('is the zip of a baked folder, in either way of packing it', async () => {
		for (const files of [baked, under('torus', baked), under('out/torus', baked)]) {
			const model = (await opened(file('My torus.zip', zipped(files)))) as OwnModel;
			expect(model.name).toBe('My torus');
			expect(model.command).toBeUndefined();
			model.source.release();
		}
	});

	it('is a baked folder, however many other files lie there', async () => {
		const more = Object.fromEntries(Array.from({ length: 250 }, (_, i) => [`notes/${i}.txt`, 'x']));
		const children = under('fox', { ...more, ...baked, '.git/config': 'x' });
		const model = (await openModel({ entries: [entry('fox', children)], files: [] }, 'en')) as OwnModel;
		expect(model).toMatchObject({ name: 'fox', source: { path: 'fox/model.gltf' } });
	});

	it('is the files of a folder all at once', async () => {
		const model = (await opened(...Object.entries(baked).map(([name, part]) => file(name, part)))) as OwnModel;
		expect(model.name).toBe('8 files');
	});

	it('is a model without fur, with the command that bakes it', async () => {
		for (const part of [triangle(), gltf({})])
			expect(await opened(file('My cat.GLB', part))).toMatchObject({
				name: 'My cat',
				command: 'npm run bake -- "My cat.GLB" -o public/models/My-cat',
			});
		const textured = gltf({ buffers: [{ uri: 'cat.bin' }], images: [{ uri: 'textures/cat.png' }] });
		const zip = zipped({ 'cat/scene.gltf': textured, 'cat/cat.bin': 'x', 'cat/textures/cat.png': 'x' });
		expect(await opened(file('cat.zip', zip))).toMatchObject({
			name: 'cat',
			command: 'npm run bake -- scene.gltf -o public/models/scene',
		});
	});
});

describe('what does not', () => {
	const expected = 'expected a baked folder, its zip, a .glb or a .ptm';
	it.each<[name: string, part: string | Uint8Array, sentence: string]>([
		[
			'cat.obj',
			'v 0 0 0',
			'it is a mesh without fur (.obj). The baker reads it:\nnpm run bake -- cat.obj -o public/models/cat',
		],
		['cat.png', 'x', `it is a picture (.png); ${expected}`],
		['cat.TXT', 'x', `it is text (.txt); ${expected}`],
		['cat.rar', 'x', `it is an archive of another kind (.rar); ${expected}`],
		['cat.blend', 'x', `it is a .blend file; ${expected}`],
		['cat', 'x', `its kind is unknown; ${expected}`],
		['plane0.png', 'x', 'it is one file of a baked folder; drop the whole folder, or its zip'],
		['notes.zip', 'words', 'it is not a zip file, despite its name'],
		['notes.zip', zipped({ 'notes.txt': 'words' }), 'there is no model.gltf in it, only notes.txt'],
		['torus.zip', zipped({ ...baked, 'model.gltf': '' }), 'model.gltf: it is not a glTF file'],
		['cat.glb', '', `it is an empty file; ${expected}`],
		['cat.gltf', 'solid cat', 'cat.gltf: it is not a glTF file'],
		['cat.gltf', 'null', 'cat.gltf: it is not a glTF file'],
		['cat.gltf', '{"asset": {"version": "1.0"}}', 'cat.gltf: it is glTF 1.0; expected 2.0'],
		['cat.glb', 'glTF\x01\0\0\0\x14\0\0\0\0\0\0\0JSON', 'cat.glb: it is glTF 1; expected 2.0'],
		[
			'cat.glb',
			'glTF\x02\0\0\0\x99\0\0\0\0\0\0\0JSON',
			'cat.glb: the end is missing: it was not copied or downloaded completely',
		],
		['cat.glb', 'glTF\x02\0\0\0\x14\0\0\0\0\0\0\0JSON', 'cat.glb: it is not a glTF file'],
		[
			'cat.gltf',
			gltf({ buffers: [{ uri: 'cat.bin' }] }),
			'cat.bin: it was not dropped with the model; drop the whole folder, or its zip',
		],
		[
			'cat.gltf',
			gltf({ images: [{ uri: 'https://example.org/fur.png' }] }),
			'https://example.org/fur.png: it is on another site; nothing is fetched for a dropped model',
		],
		[
			'cat.gltf',
			gltf({ extensionsUsed: ['KHR_draco_mesh_compression'], extensionsRequired: ['KHR_draco_mesh_compression'] }),
			'its mesh is packed by Draco, which this page does not unpack. The baker does:\nnpm run bake -- cat.gltf -o public/models/cat',
		],
		[
			'cat.gltf',
			gltf({ extensionsRequired: ['EXT_meshopt_compression', 'KHR_mesh_quantization', 'KHR_texture_basisu'] }),
			'it requires KHR_texture_basisu, which this page does not know; export it without',
		],
		[
			'cat.gltf',
			gltf({ nodes: [{ children: [1] }, { children: [0] }], scenes: [{ nodes: [0] }] }),
			'cat.gltf: its nodes form a loop; expected a tree',
		],
		['cat.gltf', gltf({ nodes: [{ children: [0] }] }), 'cat.gltf: its nodes form a loop; expected a tree'],
	])('%s: a sentence says why', async (name, part, sentence) => {
		expect(await reason(file(name, part))).toBe(sentence);
	});

	it('a baked folder without one of its files, which is named', async () => {
		for (const lost of ['plane1.png', 'model.bin', 'fin0.png', 'direction.png']) {
			const { [lost]: _, ...rest } = baked;
			expect(await reason(file('torus.zip', zipped(under('torus', rest))))).toBe(`torus/${lost}: it is not in the zip`);
		}
		const { 'model.gltf': _, ...rest } = baked;
		expect(await reason(file('torus.zip', zipped(rest)))).toBe(
			'model.gltf is missing: the other files of a baked folder are there',
		);
	});

	it('an empty folder, and one that has no end', async () => {
		const of = (children: Record<string, string>) => openModel({ entries: [entry('home', children)], files: [] }, 'en');
		expect(await of({})).toEqual({
			name: 'home',
			reason: 'the folder is empty; expected a baked folder with model.gltf',
		});
		const many = Object.fromEntries(Array.from({ length: 1200 }, (_, i) => [`home/${i}.txt`, 'x']));
		expect(await of(many)).toEqual({
			name: 'home',
			reason: 'there are more than 1000 files in it; a baked folder has about ten',
		});
	});

	it('a file that the browser may not read', async () => {
		const broken = {
			isFile: true,
			name: 'x.zip',
			fullPath: '/x.zip',
			file: (_: unknown, fail: (error: Error) => void) => fail(new Error('gone')),
		};
		expect(await openModel({ entries: [broken as never], files: [] }, 'en')).toEqual({
			name: 'x.zip',
			reason: 'the browser could not read it (gone)',
		});
	});

	it('says so in Chinese, too', async () => {
		const files = [file('notes.zip', zipped({ 'notes.txt': 'words' }))];
		expect(await openModel({ entries: [], files }, 'zh')).toEqual({
			name: 'notes.zip',
			reason: '其中没有 model.gltf，只有 notes.txt',
		});
	});
});
