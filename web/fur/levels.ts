/** Files of a pelt's planes → the mip levels of each; and those of several states, one after the other. */

import { decodePlane, type Extent, mipSteps, type Texels, type View } from './planes.ts';
import { turn, unhurried } from './steps.ts';

/** What a plane is for: `FurTextures` has one of the same name. */
export type Role = 'plane0' | 'plane1' | 'colour' | 'direction';

/** A plane as it is stored. */
export interface PlaneFile {
	role: Role;
	/** Of the file. */
	name: string;
	/** A PNG. */
	bytes: Uint8Array;
}

/** How texels are stored, and how they are looked at. */
export interface Layout {
	extent: Extent;
	coefficients: number;
	view: View;
}

/** A plane with all its mip levels. */
export interface Plane {
	role: Role;
	name: string;
	/** Level 0 first. */
	levels: Texels[];
}

/** Decodes planes one by one. @throws Error where one is not of this size; of several the first */
export async function decodeAll(files: readonly PlaneFile[], { width, height, layers }: Extent): Promise<Texels[]> {
	const texels: Texels[] = [];
	for (const { name, bytes } of files) {
		await turn();
		texels.push(decodePlane(name, bytes, width, height * layers));
	}
	return texels;
}

/**
 * Decodes the planes of a pelt and makes their mip levels, bit by bit.
 *
 * @param files those with coefficients first: the mip levels look for the coverage there
 * @throws Error as `decodeAll`
 */
export async function decodePlanes(files: readonly PlaneFile[], layout: Layout): Promise<Plane[]> {
	const { extent, coefficients, view } = layout;
	const texels = await decodeAll(files, extent);
	const mips = await unhurried(mipSteps(texels, extent, coefficients, view));
	return files.map(({ role, name }, p) => ({ role, name, levels: mips.flatMap((level) => level[p] ?? []) }));
}

/** Mip levels of several pictures of one size as those of one with all their layers. */
export function stacked(states: readonly Texels[][]): Texels[] {
	return (states[0] ?? []).map((first, level) => {
		const together = new Uint8Array(first.length * states.length);
		for (const [state, levels] of states.entries()) together.set(levels[level] as Texels, state * first.length);
		return together;
	});
}
