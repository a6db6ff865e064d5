/** Finer planes in the place of those on show: compiled and uploaded first, then gone over to. */

import { FurFade, prepareFur } from '../fur/index.ts';
import type { View } from './address.ts';
import type { Looks, Outfit } from './looks.ts';
import type { Picture } from './picture.ts';

/**
 * Has the body on show go over to the same outfits in finer planes, without a frame that waits for them.
 *
 * @param late whether something else is wanted by now
 * @returns once nothing else is seen, whether that is so
 */
export async function refine(
	picture: Picture,
	looks: Looks,
	outfits: readonly Outfit[],
	view: View,
	late: () => boolean,
): Promise<boolean> {
	const { stage, camera, still } = picture;
	const { renderer, scene, sample } = stage;
	await looks.prepare(outfits, view, (fur) => prepareFur(fur, renderer, scene, camera, sample));
	const { body } = looks;
	if (late() || !body || stage.gl.isContextLost()) return false;
	const gone = still
		? looks.wear(body, outfits, view)
		: looks.exchange(outfits, view, scene, (from, to) => new FurFade(from, to, sample.samples));
	looks.cut(view.split?.share ?? 1);
	picture.request();
	await gone;
	if (late()) return false;
	performance.mark('furbake:fine');
	return true;
}
