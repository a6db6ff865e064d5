/** Finer planes: compiled and uploaded first, then faded in. */

import { FurFade, prepareFur } from '../../fur/index.ts';
import type { Picture } from '../stage/picture.ts';
import type { Store } from '../state/store.ts';
import type { Looks, Outfit } from './looks.ts';

/**
 * Fades the body on show over to its outfits in finer planes, without a frame that waits for them.
 *
 * @param late true once something else is wanted
 * @returns after the fade: true if the finer planes are on show
 */
export async function refine(
	picture: Picture,
	looks: Looks,
	outfits: readonly Outfit[],
	store: Store,
	late: () => boolean,
): Promise<boolean> {
	const { stage, camera, still } = picture;
	const { renderer, scene, sample } = stage;
	await looks.prepare(outfits, store.get(), (fur) => prepareFur(fur, renderer, scene, camera, sample));
	const { body } = looks;
	if (late() || !body || stage.gl.isContextLost()) return false;
	const view = store.get();
	const gone = still
		? looks.show(body, outfits, view)
		: looks.fadeTo(outfits, view, scene, (from, to) => new FurFade(from, to, sample.samples));
	looks.setSplit(picture.columnOf(view.split?.share ?? 1));
	picture.request();
	await gone;
	if (late()) return false;
	performance.mark('furbake:fine');
	return true;
}
