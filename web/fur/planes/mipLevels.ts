/** Mip levels from the files of a pelt's planes; stacked for several states. */

import { decodePlane, type Extent, mipSteps, type PlaneBytes } from './planes.ts';
import { turn, unhurried } from './steps.ts';

/** Role of a plane: its key in `FurTextures`. */
export type Role = 'plane0' | 'plane1' | 'colour' | 'direction';

/** File of a plane. */
export interface PlaneFile {
	role: Role;
	/** Name of the file. */
	name: string;
	/** A PNG. */
	bytes: Uint8Array;
	/** Number of the fur, of several on one body; 0 where absent. */
	fur?: number;
}

/** Size and number of coefficients of a plane, and the height of the fur. */
export interface Layout {
	extent: Extent;
	coefficients: number;
	/** Height, widths of the tile. */
	rise: number;
	/** Heights of several furs over the first one's, tile widths. */
	heights?: readonly number[];
}

/** Layers of all furs in one state. */
export const depthOf = ({ extent, heights }: Layout): number => extent.layers * (heights?.length ?? 1);

/** A plane with all its mip levels. */
export interface Plane {
	role: Role;
	name: string;
	/** Level 0 first. */
	levels: PlaneBytes[];
}

/** Decodes planes one by one. @throws Error for the first plane of another size */
export async function decodeAll(files: readonly PlaneFile[], { width, height, layers }: Extent): Promise<PlaneBytes[]> {
	const texels: PlaneBytes[] = [];
	for (const { name, bytes } of files) {
		await turn();
		texels.push(await decodePlane(name, bytes, width, height * layers));
	}
	return texels;
}

/**
 * Decodes the planes of a pelt and makes their mip levels, in small steps.
 *
 * @param files of each fur coefficients first: the mip levels read the coverage there
 * @throws Error as in `decodeAll`
 */
export async function decodePlanes(files: readonly PlaneFile[], layout: Layout): Promise<Plane[]> {
	const { heights = [1] } = layout;
	const furs: Plane[][] = [];
	for (const [i, height] of heights.entries()) {
		const rise = layout.rise * height;
		furs.push(
			await decodeFur(
				files.filter(({ fur = 0 }) => fur === i),
				{ ...layout, rise },
			),
		);
	}
	const [coat = []] = furs;
	if (furs.length === 1) return coat;
	return coat.map((plane, p) => ({ ...plane, levels: stacked(furs.map((own) => own[p]?.levels ?? [])) }));
}

async function decodeFur(files: readonly PlaneFile[], layout: Layout): Promise<Plane[]> {
	const { extent, coefficients, rise } = layout;
	const texels = await decodeAll(files, extent);
	const mips = await unhurried(mipSteps(texels, extent, coefficients, rise));
	return files.map(({ role, name }, p) => ({ role, name, levels: mips.flatMap((level) => level[p] ?? []) }));
}

/** Mip levels of several states, or furs, as those of one texture with all their layers. */
export function stacked(states: readonly PlaneBytes[][]): PlaneBytes[] {
	return (states[0] ?? []).map((first, level) => {
		const together = new Uint8Array(first.length * states.length);
		for (const [state, levels] of states.entries()) together.set(levels[level] as PlaneBytes, state * first.length);
		return together;
	});
}
