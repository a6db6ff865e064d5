/** Light that a layer loses when the lamp sinks from above to the horizon. */

import type { Direction } from '../../fur/reference.ts';
import type { Layer } from '../data/measurements.ts';
import { layerMean } from '../mean/blocks.ts';

/** Lamps counted as above and as at the horizon: within 15° of it. */
const [ABOVE, LOW] = [Math.cos(Math.PI / 12), Math.sin(Math.PI / 12)];

/** @param lamps lamps of the layer's first measurements; @returns share of the light from above */
export function lostAtHorizon(layer: Layer, lamps: readonly Direction[]): number {
	const count = layer.texels.length;
	const mean = (kept: (z: number) => boolean) => {
		const some = lamps.flatMap(([, , z], lamp) => (kept(z) ? [lamp] : []));
		const lights = some.map((lamp) => layerMean(layer, layer.light.subarray(lamp * count, (lamp + 1) * count)));
		return lights.reduce((sum, light) => sum + light, 0) / lights.length;
	};
	return 1 - mean((z) => z < LOW) / mean((z) => z > ABOVE);
}
