/** An asset that tells how its light follows the hairs' colour, as far as that goes: two slabs, one curve. */

import { type Curves, type FurAsset, KNOTS, type Multiple } from '../../../../web/fur/format.ts';

const even = [0, 1, 2].map(() => Array.from({ length: KNOTS }, (_, i) => i / 16));
const curves: Curves = { even: [even], along: [even.map((row) => row.map(() => 0))] };

/** Half of the light in the lower slab has met several hairs in light from above, all at the horizon. */
export const multiple: Multiple = {
	albedo: 0.8,
	shares: [
		[1, -0.5, 0],
		[0.25, 0, 0.1],
	],
	ratio: [1, 0.5],
	seen: [0.25, 0.75],
	tint: [1, 0.9],
};

export const coloured: Pick<FurAsset, 'curves' | 'pelts'> = {
	curves,
	pelts: [{ name: 'dry', planes: [], scale: [], bias: [], weights: [[1], [2]], multiple }],
};
