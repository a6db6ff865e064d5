import { readFileSync } from 'node:fs';
import { BufferAttribute, BufferGeometry } from 'three';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { describe, expect, it } from 'vitest';
import { patchesOf } from '../../../web/learn/data/patches.ts';

/** A mesh of triangles by the numbers of their corners. */
function mesh(vertices: number, corners: number[]): BufferGeometry {
	const geometry = new BufferGeometry().setIndex(corners);
	return geometry.setAttribute('position', new BufferAttribute(new Float32Array(3 * vertices), 3));
}

describe('patchesOf', () => {
	it('names what hangs together, and what stands alone', () => {
		const { of, count } = patchesOf(mesh(8, [0, 1, 2, 2, 1, 3, 4, 5, 6]));
		expect(count).toBe(3);
		expect([...of]).toEqual([0, 0, 0, 0, 1, 1, 1, 2]);
	});

	it('finds in the bunny what a flood over its triangles finds', async () => {
		const folder = new URL('../../../public/models/bunny/', import.meta.url);
		const gltf = JSON.parse(readFileSync(new URL('model.gltf', folder), 'utf8'));
		const bin = readFileSync(new URL('model.bin', folder));
		const shells = gltf.meshes.find(({ name }: { name: string }) => name === 'shells').primitives[0];
		const accessor = gltf.accessors[shells.indices];
		const view = gltf.bufferViews[accessor.bufferView];
		const { byteOffset, byteLength, count, byteStride, mode } = view.extensions.EXT_meshopt_compression;
		const decoded = new Uint8Array(count * byteStride);
		await MeshoptDecoder.ready;
		MeshoptDecoder.decodeGltfBuffer(
			decoded,
			count,
			byteStride,
			bin.subarray(byteOffset, byteOffset + byteLength),
			mode,
		);
		const corners = [...new (byteStride === 4 ? Uint32Array : Uint16Array)(decoded.buffer)];
		expect(corners.length).toBe(accessor.count);
		const vertices: number = gltf.accessors[shells.attributes.POSITION].count;

		const around = Array.from({ length: vertices }, () => [] as number[]);
		for (let i = 0; i < corners.length; i += 3) {
			const [a = 0, b = 0, c = 0] = corners.slice(i, i + 3);
			around[a]?.push(b, c);
			around[b]?.push(a, c);
			around[c]?.push(a, b);
		}
		const seen = new Set<number>();
		let floods = 0;
		for (let first = 0; first < vertices; first++) {
			if (seen.has(first)) continue;
			floods++;
			const edge = [first];
			for (let at = edge.pop(); at !== undefined; at = edge.pop()) {
				if (seen.has(at)) continue;
				seen.add(at);
				edge.push(...(around[at] ?? []));
			}
		}
		expect(patchesOf(mesh(vertices, corners)).count).toBe(floods);
		expect(floods).toBeGreaterThan(50);
	});
});
