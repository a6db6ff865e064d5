/** How near a frame comes to the picture that far more work would make; `npm run quality` prints it. */

import { WebGLRenderer } from 'three';
import { loadFur, Studio } from './studio.ts';

const REFERENCE_SHELLS = 64;

export interface Quality {
	distance: number;
	azimuth: number;
	shells: number;
	/** Of the display's values over a mid grey, pixels that the reference's fur covers. */
	psnr: number;
	/** Mean linear brightness of those pixels over that of the reference. */
	brightness: number;
	pixels: number;
}

const encode = (linear: number) => {
	const c = Math.min(Math.max(linear, 0), 1);
	return c < 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
};

const GREY = 0.2; // linear

function compare(picture: Float32Array, reference: Float32Array, bare: Float32Array) {
	let [error, ours, theirs, pixels] = [0, 0, 0, 0];
	for (let i = 0; i < reference.length; i += 4) {
		// What the skin alone does not show is fur's; so is what fur changes on the skin.
		const changed = [0, 1, 2, 3].some((c) => Math.abs((reference[i + c] ?? 0) - (bare[i + c] ?? 0)) > 1e-3);
		if (!changed || (reference[i + 3] ?? 0) < 0.5) continue;
		pixels++;
		for (let c = 0; c < 3; c++) {
			const over = (rgba: Float32Array) => (rgba[i + c] ?? 0) + GREY * (1 - (rgba[i + 3] ?? 0));
			error += (encode(over(picture)) - encode(over(reference))) ** 2;
			ours += picture[i + c] ?? 0;
			theirs += reference[i + c] ?? 0;
		}
	}
	return { psnr: -10 * Math.log10(error / (3 * pixels)), brightness: ours / theirs, pixels };
}

export async function measureQuality(
	url: string,
	{
		width = 320,
		height = 240,
		distances = [0.3, 1, 4],
		azimuths = [-0.4],
		counts = [0] as number[],
		samples = 1,
		ref = 4,
	} = {},
): Promise<Quality[]> {
	const renderer = new WebGLRenderer({ antialias: false });
	const fur = await loadFur(url);
	const studio = new Studio(renderer, fur, width, height);
	const found: Quality[] = [];
	for (const distance of distances)
		for (const azimuth of azimuths) {
			studio.look(azimuth, 1.4, distance);
			studio.wear(0, false);
			const bare = studio.draw();
			studio.wear(REFERENCE_SHELLS, false);
			const reference = studio.draw(ref);
			for (const count of counts) {
				studio.wear(count || 'auto', false);
				const picture = studio.draw(samples);
				found.push({ distance, azimuth, shells: fur.shells.shellCount, ...compare(picture, reference, bare) });
			}
		}
	studio.dispose();
	renderer.dispose();
	return found;
}
