/** Controls of the panel: what each shows of a view, and what it changes in it. */

import type { Words } from '../words/en.ts';
import type { EnvironmentName, View } from './view.ts';

/** Folders of the panel, in its order. */
export const FOLDERS = ['body', 'clips', 'light', 'hair', 'weather'] as const;
export type Folder = (typeof FOLDERS)[number];

/** Keys of plain words, which name things in both languages. */
export type Label = { [Key in keyof Words]: Words[Key] extends string ? Key : never }[keyof Words];

/** Values on show, where the view leaves them to the page or a change is still under way. */
export interface Shown {
	/** '' for none */
	model: string;
	env: EnvironmentName | 'none';
	shells: number;
	colour: readonly [root: string, tip: string];
	/** '' for none */
	clip: string;
	/** seconds into the clip, and its duration */
	time: number;
	duration: number;
}

/** Abilities of the model on show. */
export interface Abilities {
	model: boolean;
	fur: boolean;
	fins: boolean;
	/** light curves of its own */
	eigen: boolean;
	/** one colour of the root for all hairs */
	root: boolean;
	/** states beside dry and clean */
	wet: boolean;
	dirt: boolean;
	/** nothing moves by itself */
	calm: boolean;
	/** one body, no crowd */
	alone: boolean;
	clips: boolean;
	/** clips may play */
	plays: boolean;
	/** its head may follow the lamp */
	looks: boolean;
}

interface Base<Shows> {
	label: Label;
	folder: Folder;
	get(view: View, shown: Shown): Shows;
	set(value: Shows, view: View, shown: Shown): Partial<View>;
	/** without it: always */
	enabled?: (able: Abilities, view: View) => boolean;
	/** without it: always */
	visible?: (view: View) => boolean;
}

export interface Slider extends Base<number> {
	kind: 'slider';
	range: readonly [min: number, max: number];
	step: number;
	/** largest value for what is on show; without it that of the range, or the present value if that is larger */
	most?: (shown: Shown) => number;
}

export interface Toggle extends Base<boolean> {
	kind: 'toggle';
}

/** sRGB as #rrggbb. */
export interface Swatch extends Base<string> {
	kind: 'colour';
}

/** A list of fixed names. */
export interface Choice extends Base<string> {
	kind: 'choice';
	names: readonly string[];
	/** group of words that has the titles of the names */
	titles: 'methods' | 'environments';
	/** without it: every name */
	allowed?: (name: string, able: Abilities) => boolean;
}

/** A list whose entries come with the list of models. */
export interface Menu extends Base<string> {
	kind: 'menu';
}

export type Control = Slider | Toggle | Swatch | Choice | Menu;

/** Makes the constructor of one kind of control. */
const maker =
	<Kind extends Control>(kind: Kind['kind']) =>
	(folder: Folder, label: Label, more: Omit<Kind, 'kind' | 'folder' | 'label'>) =>
		({ kind, folder, label, ...more }) as Kind;

export const slider = maker<Slider>('slider');
export const toggle = maker<Toggle>('toggle');
export const swatch = maker<Swatch>('colour');
export const choice = maker<Choice>('choice');
export const menu = maker<Menu>('menu');

/** Names of the values of one type. */
type NamesOf<Type> = { [Name in keyof View]-?: NonNullable<View[Name]> extends Type ? Name : never }[keyof View];
export type NumberName = NamesOf<number>;
export type FlagName = NamesOf<boolean>;

type Given = Pick<Base<unknown>, 'label' | 'folder' | 'enabled'>;

/** The slider of a number; its initial value is left out of the view. */
export function sliderOf(
	name: NumberName,
	initial: number,
	{ folder, label, ...more }: Given & Pick<Slider, 'range' | 'step'>,
): Slider {
	return slider(folder, label, {
		get: (view) => view[name] ?? initial,
		set: (value) => ({ [name]: value === initial ? undefined : value }),
		...more,
	});
}

/** The switch of a flag; its initial value is left out of the view. */
export function toggleOf(name: FlagName, initial: boolean, { folder, label, ...more }: Given): Toggle {
	return toggle(folder, label, {
		get: (view) => view[name] ?? initial,
		set: (value) => ({ [name]: value === initial ? undefined : value }),
		...more,
	});
}
