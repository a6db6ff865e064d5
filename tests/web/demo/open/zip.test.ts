import { readdirSync, readFileSync } from 'node:fs';
import { zipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { LIMITS } from '../../../../web/demo/open/files.ts';
import { crc32, unzip } from '../../../../web/demo/open/zip.ts';
import { oneBlock, sparse } from '../../deflated.ts';
import { patched, renamed, text, zipped } from './zips.ts';

const limits = { zip: 2e6, bytes: 1e6, files: 20 };
const blob = (bytes: Uint8Array<ArrayBuffer>) => new Blob([bytes]);
const message = (zip: Blob, most = limits) =>
	unzip(zip, most).then(
		(files) => `opened: ${[...files.keys()].join(', ')}`,
		(error: Error) => error.message,
	);

const good = zipped({ 'model.gltf': '{"asset": {"version": "2.0"}}', 'plane0.png': 'plane '.repeat(99) });
const zeros = zipSync({ 'model.gltf': text('{}'), 'plane0.png': new Uint8Array(900_000) }, { level: 9 });

/** A zip that only tells its size. */
class Huge extends Blob {
	override get size() {
		return 200e6;
	}
	override slice(): Blob {
		throw new Error('it was read');
	}
}

describe('a zip', () => {
	it('gives the files of a baked folder, byte for byte', async () => {
		const folder = new URL('../../../../public/models/torus-512/', import.meta.url);
		const names = readdirSync(folder);
		const bytes = names.map(
			(name) => [`torus-512/${name}`, new Uint8Array(readFileSync(new URL(name, folder)))] as const,
		);
		for (const level of [0, 6] as const) {
			const files = await unzip(blob(zipSync(Object.fromEntries(bytes), { level })));
			expect([...files.keys()].sort()).toEqual(bytes.map(([path]) => path).sort());
			for (const [path, wanted] of bytes)
				expect(Buffer.compare(wanted, Buffer.from(await (files.get(path) as Blob).arrayBuffer())), path).toBe(0);
		}
	});

	it('may have a comment, folders, empty files and the litter of systems', async () => {
		const zip = zipSync({
			'a/': new Uint8Array(),
			'a/model.gltf': text('{}'),
			'a/empty.txt': new Uint8Array(),
			'a/.DS_Store': text('x'),
			'__MACOSX/a/._model.gltf': text('x'),
			'a/Thumbs.db': text('x'),
		});
		const commented = new Uint8Array([...zip, ...text('PK\x05\x06 is how it ends')]);
		commented[zip.length - 2] = commented.length - zip.length;
		expect([...(await unzip(blob(commented))).keys()]).toEqual(['a/model.gltf', 'a/empty.txt']);
	});

	it('has names in any language', async () => {
		const files = await unzip(blob(zipped({ '皮毛/model.gltf': '{}', 'cafe\u0301.png': 'x' })));
		expect([...files.keys()]).toEqual(['皮毛/model.gltf', 'caf\u00e9.png']);
	});

	it.each<[what: string, zip: Blob, sentence: string]>([
		[
			'empty as a file',
			blob(new Uint8Array()),
			'it is an empty file; expected a baked folder, its zip, a .glb or a .ptm',
		],
		['empty as a zip', blob(zipped({})), 'the zip is empty; expected a baked folder with model.gltf'],
		['of empty folders', blob(zipped({ 'a/': '' })), 'the zip is empty; expected a baked folder with model.gltf'],
		['by its name alone', blob(text('These are words, and no zip.')), 'it is not a zip file, despite its name'],
		['cut off', blob(good.slice(0, -30)), 'the end is missing: it was not copied or downloaded completely'],
		[
			'cut off in its first file',
			blob(good.slice(0, 50)),
			'the end is missing: it was not copied or downloaded completely',
		],
		['without its beginning', blob(good.slice(40)), "the zip's list of its files is damaged"],
		['of 200 MB', new Huge(), 'the zip is 200 MB; at most 2 MB are opened'],
		['that leads up', blob(zipped({ '../../x': 'x' })), '“../../x” leads out of the zip; such a zip is not opened'],
		[
			'that leads up in the middle',
			blob(zipped({ 'a/../../x': 'x' })),
			'“a/../../x” leads out of the zip; such a zip is not opened',
		],
		[
			'with an absolute path',
			blob(zipped({ '/etc/x': 'x' })),
			'“/etc/x” leads out of the zip; such a zip is not opened',
		],
		['with a drive', blob(zipped({ 'C:/x': 'x' })), '“C:/x” leads out of the zip; such a zip is not opened'],
		[
			'that leads up by backslashes',
			blob(zipped({ '..\\x': 'x' })),
			'“..\\x” leads out of the zip; such a zip is not opened',
		],
		[
			'with backslashes',
			blob(zipped({ 'a\\x': 'x' })),
			"“a\\x” is written with a backslash; expected a zip with slashes, as today's systems pack",
		],
		[
			'with one name twice',
			blob(renamed(zipped({ 'a.png': 'x', 'b.png': 'y' }), 'b.png', 'a.png')),
			'a.png: it is in the zip twice',
		],
		[
			'with a password',
			blob(patched(good, 'plane0.png', { flags: 1 })),
			'plane0.png: it is encrypted; expected a zip without a password',
		],
		[
			'packed by LZMA',
			blob(patched(good, 'plane0.png', { method: 14 })),
			'plane0.png: it is packed by method 14; expected deflate (8) or none (0), as any system packs',
		],
		['with a wrong sum', blob(patched(good, 'plane0.png', { crc: 7 })), 'plane0.png: it is damaged in the zip'],
		[
			'with less than it tells',
			blob(patched(good, 'plane0.png', { size: 9999 })),
			'plane0.png: it is damaged in the zip',
		],
		[
			'with more than it tells',
			blob(patched(zeros, 'plane0.png', { size: 1000 })),
			'plane0.png: it unpacks to more than the 1000 bytes that the zip states; such a zip is not opened',
		],
		[
			'that is a bomb',
			blob(zipSync({ 'plane0.png': new Uint8Array(5e6) }, { level: 9 })),
			'its files are 5 MB; at most 1 MB are opened',
		],
		[
			'of many files',
			blob(zipped(Object.fromEntries(Array.from({ length: 21 }, (_, i) => [`${i}.png`, ''])))),
			'there are more than 20 files in it; a baked folder has about ten',
		],
	])('%s is refused in a sentence', async (_, zip, sentence) => {
		expect(await message(zip)).toBe(sentence);
	});

	it('is told as damaged wherever a byte of it is wrong, or opened where that byte means nothing', async () => {
		const zip = zipped({ 'model.gltf': '{"asset": {"version": "2.0"}}' });
		const plain = await (await unzip(blob(zip))).get('model.gltf')?.text();
		for (let i = 0; i < zip.length; i++) {
			const bad = zip.slice();
			bad[i] = (bad[i] as number) ^ 0xff;
			const files = await unzip(blob(bad), limits).catch((error: Error) => {
				expect(error.name, `byte ${i}: ${error.message}`).toBe('Refused');
				return undefined;
			});
			for (const file of files?.values() ?? []) expect(await file.text()).toBe(plain);
		}
	});

	it('stops a bomb that tells a small size after a piece of it', async () => {
		let state = 1;
		const noise = Uint8Array.from({ length: 150_000 }, () => {
			state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
			return state >>> 24;
		});
		const bomb = patched(zipSync({ 'plane0.png': noise }), 'plane0.png', { size: 1000 });
		let read = 0;
		const zip = blob(bomb);
		const slice = zip.slice.bind(zip);
		zip.slice = (from = 0, to = 0) => {
			if (from > 0 && to < bomb.length - 100) read += to - from;
			return slice(from, to);
		};
		expect(await message(zip)).toContain('unpacks to more than the 1000 bytes');
		expect(bomb.length).toBeGreaterThan(100_000);
		expect(read).toBeLessThan(40_000);
	});

	it('keeps every byte of a block of 400 000 literals', async () => {
		const bytes = sparse(400_000);
		const block = oneBlock(bytes);
		const stored = zipSync({ 'plane0.png': block as Uint8Array<ArrayBuffer> }, { level: 0 });
		const zip = patched(stored, 'plane0.png', { method: 8, size: bytes.length, crc: crc32(bytes) });
		const plane = (await unzip(blob(zip), limits)).get('plane0.png') as Blob;
		expect(Buffer.compare(new Uint8Array(await plane.arrayBuffer()), bytes)).toBe(0);
	});

	it('of 200 MB is more than is opened', () => {
		expect(LIMITS.zip).toBeLessThan(200e6);
	});
});

it('crc32 is that of the standard, in one piece or several', () => {
	expect(crc32(text('123456789'))).toBe(0xcbf43926);
	expect(crc32(text('6789'), crc32(text('12345')))).toBe(0xcbf43926);
});
