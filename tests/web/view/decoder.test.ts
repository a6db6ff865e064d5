/** The decoder of `<fur-view>`, which is no WebAssembly, beside three's. */

import { readFileSync } from 'node:fs';
import { MeshoptDecoder as compiled } from 'three/addons/libs/meshopt_decoder.module.js';
import { beforeAll, expect, it } from 'vitest';
import type { MeshDecoder } from '../../../web/fur/planes/meshopt.ts';
import { endingDecoder, REFERENCE } from '../../../web/tools/site/view.mjs';

interface Packed {
	buffer: number;
	byteOffset?: number;
	byteLength: number;
	byteStride: number;
	count: number;
	mode: string;
	filter?: string;
}

let plain: MeshDecoder;
const folder = new URL('../../../public/models/bunny/', import.meta.url);
const gltf = JSON.parse(readFileSync(new URL('model.gltf', folder), 'utf8'));
const bytes = new Uint8Array(readFileSync(new URL('model.bin', folder)));
const views: Packed[] = gltf.bufferViews.flatMap(
	({ extensions = {} }: { extensions?: Record<string, Packed> }) => extensions.EXT_meshopt_compression ?? [],
);
const sourceOf = ({ byteOffset = 0, byteLength }: Packed) => bytes.slice(byteOffset, byteOffset + byteLength);

beforeAll(async () => {
	const code = endingDecoder(readFileSync(REFERENCE, 'utf8'));
	plain = (await import(`data:text/javascript,${encodeURIComponent(code)}`)).MeshoptDecoder;
});

it('gives the bytes of three’s for every view of the bunny', async () => {
	expect(new Set(views.map(({ mode }) => mode)).size).toBeGreaterThan(1);
	for (const view of views) {
		const { count, byteStride, mode, filter } = view;
		const expected = await compiled.decodeGltfBufferAsync(count, byteStride, sourceOf(view), mode, filter);
		const got = await plain.decodeGltfBufferAsync(count, byteStride, sourceOf(view), mode, filter);
		expect(Buffer.compare(got, expected)).toBe(0);
	}
});

/** Bytes, or a refusal. */
async function decoded({ count, byteStride, mode, filter }: Omit<Packed, 'buffer' | 'byteLength'>, source: Uint8Array) {
	try {
		return await plain.decodeGltfBufferAsync(count, byteStride, source, mode, filter);
	} catch (error) {
		return error;
	}
}

it('comes to an end on data that is cut short', async () => {
	for (const view of views)
		for (const kept of [0, 1, 2, 17, 0.5 * view.byteLength, view.byteLength - 1]) {
			const cut = sourceOf(view).slice(0, kept);
			// Refused, or numbers that are checked afterwards.
			expect(await decoded(view, cut)).toBeDefined();
		}
	const endless = Uint8Array.of(0xd1, 0x80, 0x80);
	expect(await decoded({ count: 4, byteStride: 4, mode: 'INDICES' }, endless)).toHaveLength(16);
});
