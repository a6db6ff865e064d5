/** Fins of bodies far away. */

import type { BufferGeometry } from 'three';
import { BodyCurvature } from '../body/BodyCurvature.ts';
import { FurFollicles } from '../body/FurFollicles.ts';
import type { Fur } from '../Fur.ts';
import { finQuads } from '../fins/finQuads.ts';
import { tileOf } from '../format.ts';
import { cutFins } from '../shells/FurFins.ts';

/**
 * Fins on all edges of a surface.
 *
 * @param surface some faces of the fur's shells
 * @param strips per fin, so that light follows the height
 */
export function farFins({ asset, shells, ground }: Fur, surface: BufferGeometry, strips: number): BufferGeometry {
	const { drift, tiles = 1 } = asset;
	const { finHeights, roots } = ground;
	const width = tileOf(asset) / shells.scale.x;
	// Coordinates are those of the body, whose tiles may be of another width than the fur's.
	const tile = (width * tiles) / finHeights;
	const lean = ((drift.at(-1)?.[1] ?? 0) * width) / tile;
	const scale = roots && ([roots.scale.x / finHeights, roots.scale.y / finHeights] as const);
	const fins = cutFins(finQuads(surface, undefined, { start: 0, tile, lean, tiles: finHeights, roots: scale }), strips);
	FurFollicles.of(shells.geometry).mark(fins);
	BodyCurvature.of(shells.geometry).mark(fins, -1);
	return fins;
}
