/** Outfits of a model: which pelt it is dressed in, and which method lights it. */

import type { Fur, FurLimits, FurMethodName } from '../../fur/index.ts';
import { loadPelt, sourceAt } from '../../scene/load.ts';
import { notice } from '../say/notice.ts';
import { isRival, type Method, type View } from '../state/view.ts';
import { words } from '../words/index.ts';
import type { Outfit } from './looks.ts';
import { type MenuEntry, pelts } from './menu.ts';

/** Requested pelts: small, and often used again. */
const peltsByName = new Map<string, Promise<Fur>>();
/** Names of the loaded pelts. */
const readyPelts = new Set<string>();

/** Pelt of the menu for a method, if any. */
function peltOf(
	{ preset }: View,
	entry: MenuEntry | undefined,
	menu: readonly MenuEntry[],
	method: Method,
): MenuEntry | undefined {
	const basis = method === 'eigen' ? 'eigen' : 'ptm';
	const name = preset ?? entry?.preset;
	return pelts(menu, basis).find(({ pelt }) => pelt === name);
}

/** Pelt in the preset's own planes, finer than the model's, if any. */
function finePelt({ preset }: View, entry: MenuEntry | undefined, menu: readonly MenuEntry[]): MenuEntry | undefined {
	const name = preset ?? entry?.preset;
	return menu.find(({ pelt, fine }) => fine && pelt === name);
}

const methodsOf = ({ method, split }: View): Method[] => [method ?? 'ptm', ...(split ? [split.method] : [])];

/** True if there is an eigen pelt of the model's preset. */
export function hasEigen(view: View, entry: MenuEntry | undefined, menu: readonly MenuEntry[]): boolean {
	return peltOf(view, entry, menu, 'eigen') !== undefined;
}

/** States of a fur beside dry and clean. */
export interface States {
	wet: boolean;
	dirt: boolean;
}

/** States of a pelt in the menu. */
function statesOf(pelt: MenuEntry | undefined): States {
	return { wet: pelt?.wet === true, dirt: pelt?.dirt === true };
}

const has = ({ wet, dirt }: States) => wet || dirt;

/** States that the model can be shown in beside dry and clean. @param body its own fur */
export function statesFor(
	view: View,
	entry: MenuEntry | undefined,
	menu: readonly MenuEntry[],
	body: Fur | undefined,
): States {
	// Eigen curves hold for one state.
	const lit = view.method !== 'eigen' || (view.split && view.split.method !== 'eigen');
	if (!body || !lit) return { wet: false, dirt: false };
	if (view.preset === undefined && has(body.states)) return body.states;
	return statesOf(peltOf(view, entry, menu, 'ptm'));
}

/** The body to dress. */
export interface DressTarget {
	/** the model's own fur */
	body: Fur;
	/** true for fur that is to get wet or dirty */
	withStates: boolean;
	/** entry of the model on show */
	entry: MenuEntry | undefined;
	limits: FurLimits;
}

/**
 * @param view as `adjust` leaves it
 * @returns one outfit, or two to be shown side by side
 */
function outfitsOf(
	view: View,
	menu: readonly MenuEntry[],
	{ body, withStates, entry, limits }: DressTarget,
): Promise<Outfit[]> {
	// The pelt has states that the model's own fur lacks; dry and clean they are equal.
	const lent = withStates && !has(body.states) && has(statesOf(peltOf(view, entry, menu, 'ptm')));
	return Promise.all(
		methodsOf(view).map(async (method): Promise<Outfit> => {
			const name = method === 'eigen' ? 'ptm' : method;
			// The model's own fur suits its body better than the pelt.
			const own = method !== 'eigen' && view.preset === undefined;
			const pelt = own && !lent ? undefined : peltOf(view, entry, menu, method);
			const { tips = 1, gloss } = (own ? { gloss: entry?.gloss } : pelt) ?? {};
			return { pelt: pelt && (await load(pelt.name, limits)), tips, gloss, method: name, light: await lightOf(name) };
		}),
	);
}

/**
 * Loads the outfits of a view; where a pelt cannot be had, says why and leaves out what needs it.
 *
 * @returns outfits, and the values that the view lost
 */
export async function availableOutfits(
	view: View,
	menu: readonly MenuEntry[],
	target: DressTarget,
): Promise<{ outfits: Outfit[]; without?: Partial<View> }> {
	try {
		return { outfits: await outfitsOf(view, menu, target) };
	} catch (error) {
		const eigen = view.method === 'eigen' || view.split?.method === 'eigen';
		const name = view.preset ?? (eigen ? words.methods.eigen : undefined);
		const { message } = error as Error;
		const sentence = name ? words.presetNotShown(words.titles[name] ?? name, message) : words.statesNotShown(message);
		notice(sentence, 'error', name ? '' : 'states');
		const without = { preset: undefined, method: undefined, split: undefined, wet: undefined, dirt: undefined };
		return { outfits: await outfitsOf({ ...view, ...without }, menu, { ...target, withStates: false }), without };
	}
}

/**
 * Loads the outfits of a view in finer planes; undefined without any, and for wet or dirty fur, eigen curves and crowds,
 * which come in the model's size only.
 *
 * @param fetching false: only planes that are loaded already
 * @throws Error of one sentence where they cannot be had
 */
export async function fineOutfits(
	view: View,
	menu: readonly MenuEntry[],
	{ withStates, entry, limits }: DressTarget,
	fetching: boolean,
): Promise<Outfit[] | undefined> {
	const pelt = finePelt(view, entry, menu);
	const methods = methodsOf(view);
	if (!pelt || withStates || (view.crowd ?? 1) > 1 || methods.includes('eigen')) return undefined;
	if (!fetching && !readyPelts.has(pelt.name)) return undefined;
	// A model's own fur looks as it was baked.
	const { tips = 1, gloss } = view.preset === undefined ? {} : pelt;
	const fur = await load(pelt.name, limits);
	const named = methods.map(async (method) => ({ method: method as FurMethodName, light: await lightOf(method) }));
	return (await Promise.all(named)).map((lit) => ({ pelt: fur, tips, gloss, ...lit }));
}

/** Loads the light of a method of comparison; undefined for the fur's own. */
async function lightOf(method: Method): Promise<Outfit['light']> {
	return isRival(method) ? (await import('./later.ts')).furMethod : undefined;
}

function load(name: string, limits: FurLimits): Promise<Fur> {
	const pelt = peltsByName.get(name) ?? loadPelt(sourceAt(new URL(`models/${name}/`, document.baseURI), true), limits);
	peltsByName.set(name, pelt);
	// Retry after a failure.
	pelt.then(
		() => readyPelts.add(name),
		() => peltsByName.delete(name),
	);
	return pelt;
}
