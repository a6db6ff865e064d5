/** Runs inside the page: the bunny in one grey, lit so that its head's shadow falls on its neck. Its answers go to `shadow.spec.ts`. */

import { DirectionalLight } from 'three';
import { openBody } from '../../../web/measure/body.ts';
import type { BodyCell, BodyJob } from '../../../web/measure/bodyJob.ts';

/** Left, upper, right and lower edge, pixels. */
export type Box = readonly [number, number, number, number];

/** How a picture is drawn. */
export interface Drawing {
	method: 'ptm' | 'ptm-bare';
	/** Unit vectors to lamps beside the cell's own, which cast no shadows. */
	others?: readonly BodyCell['lamp'][];
	lampsPerFragment?: boolean;
	/** Thickness through which skin glows, share of the body's longest side. */
	glow?: number;
}

/** @returns of each drawing of the job's only cell the mean light in each of the boxes */
export async function means(
	url: string,
	job: BodyJob,
	boxes: readonly Box[],
	drawings: readonly Drawing[],
): Promise<number[][]> {
	const body = await openBody(url, job);
	const { material, skin } = body.fur;
	for (const name of ['root', 'tip', 'tip2'] as const) material[name].setScalar(0.85);
	const found = drawings.map(({ method, others = [], lampsPerFragment = false, glow = 0 }) => {
		material.lampsPerFragment = lampsPerFragment;
		material.glow = glow * body.fur.extent;
		const lamps = others.map((towards) => {
			const lamp = new DirectionalLight(0xffffff, 0.3 * job.irradiance);
			lamp.position.set(...towards);
			skin.parent?.add(lamp);
			return lamp;
		});
		const pixels = body.draw(0, method);
		for (const lamp of lamps) lamp.removeFromParent();
		return boxes.map(([left, upper, right, lower]) => {
			let sum = 0;
			for (let y = upper; y < lower; y++)
				for (let x = left; x < right; x++) sum += pixels[2 * ((job.height - 1 - y) * job.width + x)] ?? 0;
			return sum / ((right - left) * (lower - upper));
		});
	});
	body.dispose();
	return found;
}
