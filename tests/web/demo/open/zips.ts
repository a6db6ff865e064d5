/** Zips for the tests, good ones and bad ones. */

import { zipSync } from 'fflate';

export const text = (words: string) => new TextEncoder().encode(words);

/** Its directory's entry of that path, and its local header; the paths of the tests are ASCII. */
function placesOf(zip: Uint8Array, path: string): { local: number; entry: number } {
	const entry = Buffer.from(zip).toString('latin1').lastIndexOf(path) - 46;
	return { entry, local: new DataView(zip.buffer, zip.byteOffset).getUint32(entry + 42, true) };
}

/** Overwrites fields of an entry, where both headers have it. */
export function patched(
	zip: Uint8Array<ArrayBuffer>,
	path: string,
	fields: { flags?: number; method?: number; size?: number; crc?: number },
): Uint8Array<ArrayBuffer> {
	const copy = zip.slice();
	const view = new DataView(copy.buffer);
	const { local, entry } = placesOf(copy, path);
	for (const [at, field, value] of [
		[8, 6, fields.flags],
		[10, 8, fields.method],
	] as const) {
		if (value === undefined) continue;
		view.setUint16(entry + at, value, true);
		view.setUint16(local + field, value, true);
	}
	for (const [at, field, value] of [
		[16, 14, fields.crc],
		[24, 22, fields.size],
	] as const) {
		if (value === undefined) continue;
		view.setUint32(entry + at, value, true);
		view.setUint32(local + field, value, true);
	}
	return copy;
}

/** Gives an entry another path of the same length, in both headers. */
export function renamed(zip: Uint8Array<ArrayBuffer>, from: string, to: string): Uint8Array<ArrayBuffer> {
	const copy = zip.slice();
	const { local, entry } = placesOf(copy, from);
	copy.set(text(to), entry + 46);
	copy.set(text(to), local + 30);
	return copy;
}

/** @param files by path, as text or bytes; @param level 0: as they are, 6: packed */
export function zipped(files: Record<string, string | Uint8Array>, level: 0 | 6 = 6): Uint8Array<ArrayBuffer> {
	const bytes = Object.entries(files).map(([path, file]) => [path, typeof file === 'string' ? text(file) : file]);
	return zipSync(Object.fromEntries(bytes), { level });
}

/** A .glb of one triangle that faces the camera, and looks like nothing else. @param change of its JSON */
export function triangle(change: object = {}): Uint8Array<ArrayBuffer> {
	const positions = new Uint8Array(new Float32Array([-1, -1, 0, 1, -1, 0, 0, 1, 0]).buffer);
	const gltf = {
		asset: { version: '2.0' },
		scenes: [{ nodes: [0] }],
		nodes: [{ mesh: 0 }],
		meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
		accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [-1, -1, 0], max: [1, 1, 0] }],
		bufferViews: [{ buffer: 0, byteLength: positions.length }],
		buffers: [{ byteLength: positions.length }],
		...change,
	};
	const words = text(JSON.stringify(gltf));
	const json = new Uint8Array(Math.ceil(words.length / 4) * 4).fill(32);
	json.set(words);
	const head = (...values: number[]) => new Uint8Array(new Uint32Array(values).buffer);
	const size = 12 + 8 + json.length + 8 + positions.length;
	const parts = [head(0x46546c67, 2, size, json.length, 0x4e4f534a), json, head(positions.length, 0x4e4942), positions];
	return Uint8Array.from(parts.flatMap((part) => [...part]));
}
