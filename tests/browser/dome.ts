/** Runs inside the page: bent fur of a golden asset under a sky, and under as many lamps. */

import { type Light, LightProbe, PointLight, Vector3 } from 'three';
import { loadFur } from '../../web/measure/studio.ts';
import { Flat, uncovered } from './flat.ts';

/** Lamps that a shader has room for, and pictures that are added up. */
const [AT_ONCE, PICTURES] = [256, 2];

/** Texels of a layer as they are seen, [row, column]; NaN where there is no fur. */
export interface UnderDome {
	sky: number[];
	lamps: number[];
}

/**
 * @param combs displacements of the tips along T and B, share of the length
 * @param harmonics of the radiance to order 2, world axes
 * @param radius of the body, lengths of fur of half a unit, where its curvature counts
 */
export async function underDome(
	url: string,
	layer: number,
	combs: number[][],
	harmonics: number[],
	radius?: number,
): Promise<UnderDome[]> {
	const probe = new LightProbe();
	for (const [j, coefficient] of probe.sh.coefficients.entries()) coefficient.setScalar(harmonics[j] ?? 0);
	const count = AT_ONCE * PICTURES;
	const golden = Math.PI * (3 - Math.sqrt(5));
	const lamps = Array.from({ length: count }, (_, i) => {
		const y = 1 - (2 * i + 1) / count;
		const level = Math.sqrt(1 - y * y);
		const to = new Vector3(level * Math.cos(i * golden), y, level * Math.sin(i * golden));
		const lamp = new PointLight(0xffffff, (probe.sh.getAt(to, new Vector3()).x * 4 * Math.PI) / count, 0, 0);
		lamp.position.copy(to).multiplyScalar(1e4);
		return lamp;
	});
	const flat = new Flat(await loadFur(url));
	if (radius) flat.attribute('curvature', [2 / radius, 2 / radius, 0]);
	flat.add(probe, ...lamps);
	const lit = (on: (light: Light, i: number) => boolean) => {
		for (const [i, light] of [...lamps, probe].entries()) light.visible = on(light, i);
		return [...uncovered(flat.render(layer))];
	};
	const drawn = combs.map((comb) => {
		flat.attribute('_comb', comb);
		const [first = [], second = []] = [0, 1].map((part) => lit((light, i) => light !== probe && i % PICTURES === part));
		return { sky: lit((light) => light === probe), lamps: first.map((value, i) => value + (second[i] ?? 0)) };
	});
	flat.fur.dispose();
	return drawn;
}
