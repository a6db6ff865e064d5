/** What the tests of the library share: a page with nothing on it but the library, and the assets as files. */

import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import type { FurAsset } from '../../web/fur/format.ts';
import { leanOf, wayOf } from '../../web/fur/light/bent.ts';
import { openModule } from '../../web/tools/browser.mjs';
import { site } from './harness.ts';

export const repository = fileURLToPath(new URL('../..', import.meta.url));
export const served = (path: string) =>
	path.startsWith('public/') ? path.slice('public'.length) : `/@fs${repository}${path}`;

/** An empty page with a module of `inPage/`, whose exports are the global `loaded`. */
export const openInPage = (page: Page, name: string) => openModule(page, site, `/inPage/${name}.js`);

/** A page with nothing on it but the library. */
export const openStage = (page: Page) => openInPage(page, 'stage');

export async function readAsset(folder: string): Promise<{ fur: FurAsset; images: { uri: string }[] }> {
	const gltf = JSON.parse(await readFile(`${repository}${folder}/model.gltf`, 'utf8'));
	return { fur: gltf.extensions.FUR_ptm_shells, images: gltf.images };
}

/**
 * Factor, under a lamp along (T, B, N), of the share of light that has met several hairs, where hairs lean.
 * @param opposite −cos of the angle from the eye to the lamp, at least 0
 */
export function leaning(
	fur: Pick<FurAsset, 'drift' | 'height'>,
	[t, b, n]: readonly [number, number, number],
	opposite = 0,
): number {
	const [u, v] = wayOf(fur);
	const towards = (t * u + b * v) / Math.hypot(t, b, Math.max(n, 0));
	return Math.exp(Math.min(0.66 * leanOf(fur).length(), 0.33) * (towards + 1.1 * opposite) + 0.35 * opposite + 0.03);
}

export async function readFloats(path: string): Promise<Float32Array> {
	const bytes = await readFile(`${repository}${path}`);
	return new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

export const floats = (base64: string) => new Float32Array(Uint8Array.from(Buffer.from(base64, 'base64')).buffer);
