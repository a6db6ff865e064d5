/** What a model can wear: the pelt of each preset, and each of them with light curves found for it (eigen). */

import type { Fur, MethodName, TextureLimits } from '../fur/index.ts';
import type { Method, View } from './address.ts';
import type { Outfit } from './looks.ts';
import { loadPelt, type MenuEntry, pelts, sourceAt } from './models.ts';
import { notice } from './notice.ts';
import { words } from './words/index.ts';

/** Those on their way or there: pelts are small, and come back often. */
const loaded = new Map<string, Promise<Fur>>();
/** Those that are there. */
const here = new Set<string>();

/** The pelt in the menu that this method needs; undefined: there is none. */
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

/** The pelt with the planes of its own preset, finer than the model's; undefined: there is none. */
function finePelt({ preset }: View, entry: MenuEntry | undefined, menu: readonly MenuEntry[]): MenuEntry | undefined {
	const name = preset ?? entry?.preset;
	return menu.find(({ pelt, fine }) => fine && pelt === name);
}

const methodsOf = ({ method, split }: View): Method[] => [method ?? 'ptm', ...(split ? [split.method] : [])];

/** Whether there are eigen curves for what the model wears. */
export function hasEigen(view: View, entry: MenuEntry | undefined, menu: readonly MenuEntry[]): boolean {
	return peltOf(view, entry, menu, 'eigen') !== undefined;
}

/** States of a fur beside dry and clean. */
export interface States {
	wet: boolean;
	dirt: boolean;
}

/** What the pelt in the menu has. */
function statesOf(pelt: MenuEntry | undefined): States {
	const options = pelt?.options ?? [];
	return { wet: options.includes('--states'), dirt: options.includes('--dirt') };
}

const has = ({ wet, dirt }: States) => wet || dirt;

/** What the model can be shown in beside dry and clean. @param body its own fur */
export function statesFor(
	view: View,
	entry: MenuEntry | undefined,
	menu: readonly MenuEntry[],
	body: Fur | undefined,
): States {
	// Eigen curves are those of one state.
	const lit = view.method !== 'eigen' || (view.split && view.split.method !== 'eigen');
	if (!body || !lit) return { wet: false, dirt: false };
	if (view.preset === undefined && has(body.hasStates)) return body.hasStates;
	return statesOf(peltOf(view, entry, menu, 'ptm'));
}

/** Whether it is one to compare with, not the fur's own light. */
export const isRival = (method: Method) => method !== 'ptm' && method !== 'eigen';

/** Takes out of the view what this model cannot wear. @returns why */
export function adjust(view: View, entry: MenuEntry | undefined, menu: readonly MenuEntry[]): string[] {
	const reasons = new Set<string>();
	if (view.preset && !pelts(menu).some(({ pelt }) => pelt === view.preset)) {
		const names = pelts(menu).map(({ pelt }) => pelt);
		reasons.add(words.wrongPreset(view.preset, names.join(', ')));
		view.preset = undefined;
	}
	if (!hasEigen(view, entry, menu)) {
		if (view.method === 'eigen' || view.split?.method === 'eigen') reasons.add(words.noEigenHere);
		if (view.method === 'eigen') view.method = undefined;
		if (view.split?.method === 'eigen') view.split = undefined;
	}
	if ((view.crowd ?? 1) > 1 && (view.split || isRival(view.method ?? 'ptm'))) {
		reasons.add(words.crowdWears);
		view.split = undefined;
		if (isRival(view.method ?? 'ptm')) view.method = undefined;
	}
	return [...reasons];
}

/** Whom outfits are for. */
export interface Wearer {
	/** the model's own fur */
	body: Fur;
	/** whether it is to get wet or dirty */
	soiled: boolean;
	/** of the menu */
	entry: MenuEntry | undefined;
	limits: TextureLimits;
}

/**
 * @param view what can be worn, as `adjust` leaves it
 * @returns one outfit, or two to be shown side by side
 */
function outfitsOf(view: View, menu: readonly MenuEntry[], { body, soiled, entry, limits }: Wearer): Promise<Outfit[]> {
	// What its own fur does not know its pelt does; dry and clean they are the same.
	const lent = soiled && !has(body.hasStates) && has(statesOf(peltOf(view, entry, menu, 'ptm')));
	return Promise.all(
		methodsOf(view).map(async (method): Promise<Outfit> => {
			const name = method === 'eigen' ? 'ptm' : method;
			// A model's own fur is what it was baked with, and better than its pelt.
			const own = method !== 'eigen' && view.preset === undefined;
			const pelt = own && !lent ? undefined : peltOf(view, entry, menu, method);
			const { tips = 1, gloss } = (!own && pelt) || {};
			return { pelt: pelt && (await load(pelt.name, limits)), tips, gloss, method: name };
		}),
	);
}

/**
 * The same; where a pelt cannot be had, says why and takes out of the view what needs it.
 *
 * @returns outfits, and whether they are what was asked for
 */
export async function availableOutfits(
	view: View,
	menu: readonly MenuEntry[],
	wearer: Wearer,
): Promise<{ outfits: Outfit[]; whole: boolean }> {
	try {
		return { outfits: await outfitsOf(view, menu, wearer), whole: true };
	} catch (error) {
		const eigen = view.method === 'eigen' || view.split?.method === 'eigen';
		const name = view.preset ?? (eigen ? words.methods.eigen : undefined);
		const { message } = error as Error;
		const sentence = name ? words.presetNotShown(words.titles[name] ?? name, message) : words.statesNotShown(message);
		notice(sentence, 'error', name ? '' : 'states');
		Object.assign(view, { preset: undefined, method: undefined, split: undefined, wet: undefined, dirt: undefined });
		return { outfits: await outfitsOf(view, menu, { ...wearer, soiled: false }), whole: false };
	}
}

/**
 * The same outfits in finer planes; undefined where there are none: wet and dirty fur, eigen curves and crowds have theirs
 * in the model's size alone.
 *
 * @param fetching false: only where they have come before
 * @throws Error of one sentence where they cannot be had
 */
export async function fineOutfits(
	view: View,
	menu: readonly MenuEntry[],
	{ soiled, entry, limits }: Wearer,
	fetching: boolean,
): Promise<Outfit[] | undefined> {
	const pelt = finePelt(view, entry, menu);
	const methods = methodsOf(view);
	if (!pelt || soiled || (view.crowd ?? 1) > 1 || methods.includes('eigen')) return undefined;
	if (!fetching && !here.has(pelt.name)) return undefined;
	// A model's own fur looks as it was baked.
	const { tips = 1, gloss } = view.preset === undefined ? {} : pelt;
	const fur = await load(pelt.name, limits);
	return methods.map((method) => ({ pelt: fur, tips, gloss, method: method as MethodName }));
}

function load(name: string, limits: TextureLimits): Promise<Fur> {
	const pelt = loaded.get(name) ?? loadPelt(sourceAt(new URL(`models/${name}/`, document.baseURI)), limits);
	loaded.set(name, pelt);
	// What has failed may come another time.
	pelt.then(
		() => here.add(name),
		() => loaded.delete(name),
	);
	return pelt;
}
