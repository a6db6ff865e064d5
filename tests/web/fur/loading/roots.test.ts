/** The picture of the roots of the golden asset: every place of the fur finds the stripe on which it stands. */

import { decode } from 'fast-png';
import type { BufferAttribute } from 'three';
import { expect, it, vi } from 'vitest';
import type { Fur } from '../../../../web/fur/index.ts';
import { golden, load, refusal, restoreNetwork, serve } from './assets.ts';

restoreNetwork();

/** Stripes across the square, the first one black. */
const STRIPES = 8;

const { json, files } = golden('roots');
const picture = decode(files['roots.png'] as Uint8Array);

/** Serves the files, also to three's loader of pictures, which asks by address. */
function serveAll(): void {
	serve(files);
	const fetched = fetch;
	vi.stubGlobal('fetch', (given: Request | string) => fetched(typeof given === 'string' ? new Request(given) : given));
	vi.stubGlobal('self', globalThis);
	vi.stubGlobal('createImageBitmap', async (blob: Blob) => ({ size: blob.size }));
}

/** Red of the texel at a place of the picture. */
function redAt(u: number, v: number): number {
	const [column, row] = [Math.floor(u * picture.width), Math.floor(v * picture.height)];
	return picture.data[picture.channels * (row * picture.width + column)] as number;
}

it('gives shells and fins the colours of their stripes', async () => {
	serveAll();
	const fur: Fur = (await load(json)).userData.fur;
	const { roots, rootsUnit, tiles } = fur.material.uniforms;
	expect(roots?.value.image.size).toBe(files['roots.png']?.length);
	expect(roots?.value.flipY).toBe(false);
	const unit = rootsUnit?.value.clone().multiplyScalar(tiles?.value);
	for (const [part, name, scale] of [
		[fur.shells, 'uv', unit],
		[fur.fins, 'uv1', { x: 1, y: 1 }],
	] as const) {
		const [place, uv] = ['position', name].map((key) => part?.geometry.getAttribute(key)) as BufferAttribute[];
		const index = part?.geometry.index as BufferAttribute;
		let seen = 0;
		const xs = Array.from({ length: place?.count as number }, (_, i) => place?.getX(i) as number);
		const [left, right] = [Math.min(...xs), Math.max(...xs)];
		for (let i = 0; i < index.count; i += 3) {
			const corners = [index.getX(i), index.getX(i + 1), index.getX(i + 2)];
			const mean = (of: (corner: number) => number) => corners.reduce((sum, corner) => sum + of(corner), 0) / 3;
			const across = (mean((v) => xs[v] as number) - left) * (STRIPES / (right - left));
			if (Math.abs(across - Math.round(across)) < 0.2) continue;
			seen++;
			const red = redAt(
				mean((v) => (uv as BufferAttribute).getX(v)) * scale.x,
				mean((v) => (uv as BufferAttribute).getY(v)) * scale.y,
			);
			expect(red, `${name} at ${across}`).toBe(Math.floor(across) % 2 ? 255 : 0);
		}
		expect(seen, name).toBeGreaterThan(index.count / 9);
	}
});

it('is missed by name', async () => {
	serveAll();
	const without = structuredClone(json);
	without.extensions.FUR_ptm_shells.roots.texture = 9;
	expect(await refusal(without)).toMatch(/roots.*9/);
});
