/** Names and places in the glTF extension `FUR_ptm_shells`. Free of three. */

import type { FurAsset, Slot } from './format/types.ts';

export * from './format/types.ts';

/** Name of the extension in a glTF file. */
export const FUR_EXTENSION = 'FUR_ptm_shells';

/** Newest version that this reader supports; of a higher major version the skin alone is shown. */
export const FUR_VERSION = '2.3';

/** Extensions of a buffer view that is compressed. */
export const PACKED = ['EXT_meshopt_compression', 'KHR_meshopt_compression'];

/** True for an extension of a higher major version than this reader's: its skin alone is shown. */
export function isNewer(extension: unknown): boolean {
	const version = (extension as { version?: unknown } | null)?.version;
	return typeof version === 'string' && Number.parseInt(version, 10) > Number.parseInt(FUR_VERSION, 10);
}

/** The furs of an asset, each as if it were alone: the coat, then those of its regions. */
export function fursOf({ regions, ...coat }: FurAsset): [FurAsset, ...FurAsset[]] {
	const furs = regions?.furs ?? [];
	return [
		coat,
		...furs.map(
			({ name: _, tile: __, ...own }) =>
				({
					...coat,
					eye: undefined,
					finEye: undefined,
					surge: undefined,
					spread: undefined,
					open: undefined,
					short: undefined,
					bent: undefined,
					...own,
				}) as FurAsset,
		),
	];
}

/** Width of a tile of the coat, model units. */
export const tileOf = ({ regions, length, height }: Pick<FurAsset, 'regions' | 'length' | 'height'>): number =>
	regions?.tile ?? length / height;

/** Place of coefficient `i`. */
export function channelOf(i: number): Slot {
	if (i < 3) return { plane: 0, channel: i };
	return i === 5 ? { plane: 0, channel: 3 } : { plane: 1, channel: i - 3 };
}

/** Place of the coverage α. */
export function alphaChannel(coefficients: number): Slot {
	return coefficients > 3 ? { plane: 1, channel: 2 } : { plane: 0, channel: 3 };
}
