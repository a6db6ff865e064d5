import type { BufferGeometry } from 'three';
import type { FurPose } from '../../body/FurPose.ts';
import type { Fin } from '../../format.ts';
import type { FurTextures } from '../../light/texels.ts';
import { FurFinMaterial } from '../FurFinMaterial.ts';
import { FurFins } from '../FurFins.ts';
import type { FurMaterial } from '../FurMaterial.ts';

/**
 * Fins of a body, in the colours and lengths of its shells.
 *
 * @param ground quads of the fins, and the factor of their second texture coordinate that makes it 1 at the tips
 */
export function growFins(
	{ quads, finHeights }: { quads: BufferGeometry; finHeights: number },
	fin: Fin,
	textures: FurTextures,
	shells: FurMaterial,
	pose: FurPose | undefined,
): FurFins {
	return new FurFins(quads, new FurFinMaterial(fin, textures, shells, { finHeights }), pose);
}
