import { type FurAsset, fursOf } from '../format.ts';

/**
 * Furs of an asset whose hairs are stored: all of them, or the coat alone where the others have its hairs and differ in size
 * and colours at most.
 */
export function hairsOf(asset: FurAsset): [FurAsset, ...FurAsset[]] {
	const furs = fursOf(asset);
	const hairs = furs.map(({ ramp: _, ...own }) => JSON.stringify(own));
	return hairs.every((own) => own === hairs[0]) ? [furs[0]] : furs;
}
