import { describe, expect, it } from 'vitest';
import { type Container, type Files, fileOf, findModel, sourceOf } from '../../../../web/demo/open/files.ts';

const filesOf = (...paths: string[]): Files => new Map(paths.map((path) => [path, new Blob([path])]));
const model = (...paths: string[]) => {
	try {
		return findModel(filesOf(...paths));
	} catch (error) {
		return (error as Error).message;
	}
};

describe('the model among the files', () => {
	it.each<[found: string, ...paths: string[]]>([
		['model.gltf', 'model.gltf', 'model.bin'],
		['fox/model.gltf', 'fox/model.gltf', 'fox/plane0.png', 'notes/read.txt'],
		['out/fox/model.gltf', 'out/fox/model.gltf', 'out/fox/model.bin'],
		['model.gltf', 'model.gltf', 'old/model.gltf', 'other.glb'],
		['MODEL.GLTF', 'MODEL.GLTF'],
		['scene.gltf', 'scene.gltf', 'scene.bin', 'textures/a.png'],
		['cat.glb', 'cat.glb', 'license.txt'],
	])('is %s', (found, ...paths) => {
		expect(model(...paths)).toBe(found);
	});

	it.each<[sentence: string, ...paths: string[]]>([
		['there is no model.gltf in it, only notes.txt', 'notes.txt'],
		['there is no model.gltf in it, only a.txt, b.txt and 2 more', 'a.txt', 'b.txt', 'c.txt', 'd.txt'],
		['there is no model.gltf in it, only a/b/c/model.gltf', 'a/b/c/model.gltf'],
		['model.gltf is missing: the other files of a baked folder are there', 'fox/plane0.png', 'fox/model.bin'],
		['there are several models in it (a/model.gltf, b/model.gltf); expected one', 'a/model.gltf', 'b/model.gltf'],
		['there are several models in it (a.glb, b.glb); expected one', 'a.glb', 'b.glb'],
	])('or else: %s', (sentence, ...paths) => {
		expect(model(...paths)).toBe(sentence);
	});
});

describe('the file that a glTF file means', () => {
	const files = filesOf(
		'fox/model.gltf',
		'fox/plane0.png',
		'fox/own maps/caf\u00e9 1.png',
		'common/skin.png',
		'fox/100%.png',
	);
	const meant = async (uri: string, container: Container = 'zip') => {
		try {
			return await fileOf(files, uri, 'fox/model.gltf', container).text();
		} catch (error) {
			return (error as Error).message;
		}
	};

	it.each([
		['plane0.png', 'fox/plane0.png'],
		['./plane0.png', 'fox/plane0.png'],
		['Plane0.PNG', 'fox/plane0.png'],
		['own%20maps/caf%C3%A9%201.png', 'fox/own maps/caf\u00e9 1.png'],
		['own maps/cafe\u0301 1.png', 'fox/own maps/caf\u00e9 1.png'],
		['../common/skin.png', 'common/skin.png'],
		['100%.png', 'fox/100%.png'],
		['plane1.png', 'fox/plane1.png: it is not in the zip'],
		['../../x', 'fox/../../x: it is not in the zip'],
		[
			'https://example.org/plane0.png',
			'https://example.org/plane0.png: it is on another site; nothing is fetched for a dropped model',
		],
		['//example.org/x', '//example.org/x: it is on another site; nothing is fetched for a dropped model'],
		['/models/x', '/models/x: it is on another site; nothing is fetched for a dropped model'],
		['blob:null/0', 'blob:null/0: it is on another site; nothing is fetched for a dropped model'],
		['file:///etc/passwd', 'file:///etc/passwd: it is on another site; nothing is fetched for a dropped model'],
	])('%s is %s', async (uri, wanted) => {
		expect(await meant(uri)).toBe(wanted);
	});

	it('is told as missing by how the others came', async () => {
		expect(await meant('x.bin', 'folder')).toBe('fox/x.bin: it is not in the folder');
		expect(await meant('x.bin', 'file')).toBe(
			'fox/x.bin: it was not dropped with the model; drop the whole folder, or its zip',
		);
	});
});

describe('a source', () => {
	it('gives each file an address when it is asked for, and takes all back', async () => {
		const { createObjectURL, revokeObjectURL } = URL;
		const living = new Set<string>();
		URL.createObjectURL = (blob) => {
			const address = createObjectURL(blob);
			living.add(address);
			return address;
		};
		URL.revokeObjectURL = (address) => {
			living.delete(address);
			revokeObjectURL(address);
		};
		try {
			const source = sourceOf(filesOf('a b/model.gltf', 'a b/plane 0.png', 'never.png'), 'a b/model.gltf', 'zip');
			const load = async (url: string) => (await fetch(source.manager?.resolveURL(url) ?? '')).text();
			expect(living.size).toBe(0);
			expect(await load(source.url)).toBe('a b/model.gltf');
			const folder = source.url.slice(0, source.url.lastIndexOf('/') + 1);
			expect(await load(`${folder}plane%200.png`)).toBe('a b/plane 0.png');
			expect(await load(`${folder}plane 0.png`)).toBe('a b/plane 0.png');
			expect(living.size).toBe(2);
			source.release();
			expect(living.size).toBe(0);
			expect(() => source.manager?.resolveURL(source.url)).toThrow('it is not in the zip');
		} finally {
			Object.assign(URL, { createObjectURL, revokeObjectURL });
		}
	});

	it('leads nowhere else', () => {
		const { manager, url } = sourceOf(filesOf('model.gltf'), 'model.gltf', 'zip');
		for (const address of ['https://example.org/x.png', '//example.org/x.png', 'models/x.png', '/x.png', ''])
			expect(() => manager?.resolveURL(address)).toThrow('nothing is fetched for a dropped model');
		expect(() => manager?.resolveURL(`${url}/../plane1.png`)).toThrow('plane1.png: it is not in the zip');
		expect(manager?.resolveURL('data:,x')).toBe('data:,x');
	});
});
