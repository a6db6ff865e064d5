/** Views that can come true: takes out what the model on show does not support. */

import type { Fur } from '../../fur/index.ts';
import { isRival, type View } from '../state/view.ts';
import type { Words } from '../words/en.ts';
import { type MenuEntry, pelts } from './menu.ts';
import { hasEigen } from './outfits.ts';

/** Whether fur can stand in no crowd: herds have no room for several furs on joints. */
export const standsAlone = ({ asset, shells }: Fur): boolean => Boolean(asset.regions && shells.skeleton);

/** Picks a sentence out of a language's words. */
export type Reason = (words: Words) => string;

/**
 * Leaves out of a view what cannot be shown.
 *
 * @param alone whether the model can stand in no crowd
 * @returns the view that is left, and why
 */
export function adjust(
	asked: View,
	entry: MenuEntry | undefined,
	menu: readonly MenuEntry[],
	alone = false,
): { view: View; reasons: Reason[] } {
	let view = asked;
	const reasons: Reason[] = [];
	const leaveOut = (patch: Partial<View>) => {
		view = { ...view, ...patch };
	};
	const { preset } = view;
	if (preset && !pelts(menu).some(({ pelt }) => pelt === preset)) {
		const names = pelts(menu).map(({ pelt }) => pelt);
		reasons.push((words) => words.wrongPreset(preset, names.join(', ')));
		leaveOut({ preset: undefined });
	}
	const withoutEigen = ({ method, split }: View): Partial<View> => ({
		...(method === 'eigen' && { method: undefined }),
		...(split?.method === 'eigen' && { split: undefined }),
	});
	if (!hasEigen(view, entry, menu) && Object.keys(withoutEigen(view)).length > 0) {
		reasons.push((words) => words.noEigenHere);
		leaveOut(withoutEigen(view));
	}
	if ((view.crowd ?? 1) > 1 && alone) {
		reasons.push((words) => words.standsAlone);
		leaveOut({ crowd: undefined });
	}
	const rival = isRival(view.method ?? 'ptm');
	if ((view.crowd ?? 1) > 1 && (view.split || rival)) {
		reasons.push((words) => words.rivalLeftOut);
		leaveOut({ split: undefined, ...(rival && { method: undefined }) });
	}
	return { view, reasons };
}
