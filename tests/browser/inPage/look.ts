/** Runs inside the page: the bunny in one colour with the demo's highlights and light from behind, and without. For `look.spec.ts`. */

import { openBody } from '../../../web/measure/body.ts';
import type { BodyJob } from '../../../web/measure/bodyJob.ts';
import { DEFAULT_LOOK } from '../../../web/page/look.ts';

/** Mean light of parts of a picture. */
export interface Parts {
	/** All that fur covers. */
	all: number;
	/** Fur beyond the outline of the skin. */
	rim: number;
	/** What is turned away from the lamp by more than 107°. */
	face: number;
}

/** Of n·l, what is turned away. */
const AWAY = -0.3;

/** @returns of each cell the parts without either, and by the demo's defaults */
export async function parts(url: string, job: BodyJob): Promise<{ none: Parts; usual: Parts }[]> {
	const body = await openBody(url, job);
	const { material } = body.fur;
	for (const name of ['root', 'tip', 'tip2'] as const) material[name].setScalar(0.85);
	const found = job.cells.map(({ lamp }, cell) => {
		const normals = body.normals(cell);
		const features = body.features(cell);
		const drawn = (look: typeof DEFAULT_LOOK): Parts => {
			Object.assign(material, look);
			const pixels = body.draw(cell, 'ptm');
			const sums = { all: [0, 0], rim: [0, 0], face: [0, 0] };
			for (let at = 0; at < pixels.length; at += 2) {
				if ((pixels[at + 1] ?? 0) < 0.5 || features[at + 1]) continue;
				const [x = 0, y = 0, z = 0, skin = 0] = normals.subarray(2 * at, 2 * at + 4);
				const cosine = x * lamp[0] + y * lamp[1] + z * lamp[2];
				const of = skin ? (cosine < AWAY ? [sums.all, sums.face] : [sums.all]) : [sums.all, sums.rim];
				for (const sum of of) {
					sum[0] = (sum[0] ?? 0) + (pixels[at] ?? 0);
					sum[1] = (sum[1] ?? 0) + 1;
				}
			}
			const mean = ([light = 0, count = 0]: number[]) => light / count;
			return { all: mean(sums.all), rim: mean(sums.rim), face: mean(sums.face) };
		};
		return { none: drawn({ gloss: 0, backlight: 0 }), usual: drawn(DEFAULT_LOOK) };
	});
	body.dispose();
	return found;
}

/** @returns mean light of all fur that highlights add, by the colour of the hairs */
export async function shine(url: string, job: BodyJob, colours: [number, number, number][]): Promise<number[]> {
	const body = await openBody(url, job);
	const { material } = body.fur;
	const features = body.features(0);
	const found = colours.map((colour) => {
		for (const name of ['root', 'tip', 'tip2'] as const) material[name].setRGB(...colour);
		const [plain = 0, shiny = 0] = [0, DEFAULT_LOOK.gloss].map((gloss) => {
			Object.assign(material, { gloss, backlight: 0 });
			const pixels = body.draw(0, 'ptm');
			let light = 0;
			let count = 0;
			for (let at = 0; at < pixels.length; at += 2) {
				if ((pixels[at + 1] ?? 0) < 0.5 || features[at + 1]) continue;
				light += pixels[at] ?? 0;
				count++;
			}
			return light / count;
		});
		return shiny - plain;
	});
	body.dispose();
	return found;
}
