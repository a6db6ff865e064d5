import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { hairsOf } from '../../../web/fur/format/hairsOf.ts';
import type { FurAsset, RegionFur } from '../../../web/fur/format.ts';

const golden = (name: string): FurAsset =>
	JSON.parse(readFileSync(new URL(`../../golden/${name}/model.gltf`, import.meta.url), 'utf8')).extensions
		.FUR_ptm_shells;

it.each(['regions', 'regions-3', 'regions-4', 'ptm-6'])('stores hairs that all furs have once: %s', (name) => {
	expect(hairsOf(golden(name))).toHaveLength(1);
});

it.each<[string, number, (fur: RegionFur) => void]>([
	['colours', 1, ({ ramp }) => Object.assign(ramp, { tip: [0, 0, 1] })],
	['the width of a tile', 1, (fur) => Object.assign(fur, { tile: 2 })],
	['texels', 3, ({ pelts }) => pelts[0]?.planes.reverse()],
	['height', 3, (fur) => Object.assign(fur, { height: 2 * fur.height })],
	['the way it leans', 3, ({ drift }) => drift.at(-1)?.reverse()],
])('keeps furs apart by hairs, not by size and colours: another fur differs in %s', (_, furs, change) => {
	const asset = golden('regions-3');
	change(asset.regions?.furs[1] as RegionFur);
	expect(hairsOf(asset)).toHaveLength(furs);
});
