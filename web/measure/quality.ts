/** Error of a frame against a far more costly reference, printed by `npm run quality`. */

import { WebGLRenderer } from 'three';
import type { Quality } from './figures.ts';
import { loadFur, Studio } from './studio.ts';

const REFERENCE_SHELLS = 64;
const REFERENCE_SAMPLES = 4; // per pixel and axis
const GREY = 0.2; // linear, behind the fur

const VIEWS = [
	{ azimuth: -0.4, polar: 1.4 },
	{ azimuth: 2, polar: 1 },
] as const;

/** sRGB value, 0..1, of linear light. */
function encode(linear: number): number {
	const c = Math.min(Math.max(linear, 0), 1);
	return c < 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
}

/**
 * Compares pixels that the reference's fur covers at least half: those that differ from the skin alone.
 *
 * @param pictures rgba, premultiplied, linear
 */
export function compare(picture: Float32Array, reference: Float32Array, skin: Float32Array) {
	let [squares, light, wanted, pixels] = [0, 0, 0, 0];
	for (let i = 0; i < reference.length; i += 4) {
		const changed = [0, 1, 2, 3].some((c) => Math.abs((reference[i + c] ?? 0) - (skin[i + c] ?? 0)) > 1e-3);
		if (!changed || (reference[i + 3] ?? 0) < 0.5) continue;
		pixels++;
		for (let c = 0; c < 3; c++) {
			const shown = (rgba: Float32Array) => encode((rgba[i + c] ?? 0) + GREY * (1 - (rgba[i + 3] ?? 0)));
			squares += (shown(picture) - shown(reference)) ** 2;
			light += picture[i + c] ?? 0;
			wanted += reference[i + c] ?? 0;
		}
	}
	return { psnr: -10 * Math.log10(squares / (3 * pixels)), brightness: light / wanted, pixels };
}

/**
 * @param url of an asset's model.gltf
 * @param distances distances over that at which the model fills the picture
 */
export async function measureQuality(
	url: string,
	{ width = 320, height = 240, distances = [0.3, 1, 3] as readonly number[] } = {},
): Promise<Quality[]> {
	const fur = await loadFur(url);
	const renderer = new WebGLRenderer({ antialias: false });
	const studio = new Studio(renderer, fur, width, height);
	const fins = fur.fins !== undefined;
	const found = distances.flatMap((distance) =>
		VIEWS.map(({ azimuth, polar }) => {
			studio.look(azimuth, polar, distance);
			studio.showFur(0, false);
			const skin = studio.draw();
			studio.showFur(REFERENCE_SHELLS, fins);
			const reference = studio.draw(REFERENCE_SAMPLES);
			studio.showFur('auto', fins);
			const picture = studio.draw();
			return { distance, azimuth, shells: fur.shells.shellCount, ...compare(picture, reference, skin) };
		}),
	);
	studio.dispose();
	renderer.dispose();
	return found;
}
