/** Two discs of one fur: by the law of light and eye, and without it. */

import { CircleGeometry, Float32BufferAttribute, MathUtils, type PlaneGeometry } from 'three';
import type { Fur, FurAsset } from '../../fur/index.ts';
import { FurPatch, tiled } from '../patch.ts';

const TILES = 4;
/** Squares of the mesh across, many for a round rim. */
const CELLS = 48;
/** Radius of the discs. */
export const RADIUS = TILES / 2;
/** Rim over which the fur thins out and shortens, share of the radius. */
const RIM = 0.12;

/** @param leaning direction of the hairs' tips, degrees from the front to the right */
export function napPatches({ asset, pelt, ground }: Fur, leaning: number): [lawful: FurPatch, plain: FurPatch] {
	const patchOf = (each: FurAsset) => {
		const patch = new FurPatch({ asset: each, pelt, ground }, TILES, rounded());
		patch.rotation.y = MathUtils.degToRad(leaning - 90) - leanOnTile(asset);
		patch.skin.geometry.dispose();
		patch.skin.geometry = new CircleGeometry(RADIUS * (1 - RIM / 2), 64).rotateX(-Math.PI / 2);
		return patch;
	};
	// Without these numbers texels look from anywhere as from straight above.
	const { eye: _, surge: __, ...plain } = asset;
	return [patchOf(asset), patchOf(plain)];
}

/** Square of tiles with a disc of fur. */
function rounded(): PlaneGeometry {
	const surface = tiled(TILES, CELLS);
	const position = surface.getAttribute('position');
	const mask: number[] = [];
	for (let i = 0; i < position.count; i++) {
		const away = Math.hypot(position.getX(i), position.getZ(i)) / RADIUS;
		const dense = MathUtils.smoothstep(1 - away, 0, RIM);
		mask.push(dense, 0.4 + 0.6 * dense, 1, 0);
	}
	return surface.setAttribute('_fur', new Float32BufferAttribute(mask, 4));
}

/** Direction of the tips on the tile, radians from u to v. */
function leanOnTile({ drift }: Pick<FurAsset, 'drift'>): number {
	const [u, v] = drift.at(-1) ?? [0, 1];
	return Math.atan2(v, u);
}
