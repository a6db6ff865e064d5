/** A row of the table of parameters, and the one of a number in a range. */

import { type Control, type NumberName, type Slider, sliderOf } from './controls.ts';
import * as values from './values.ts';

/** Part of the page that follows a change: model, environment, fur, or the style of what is on show. */
export type Part = 'model' | 'environment' | 'fur' | 'style';

export interface Parameter<Type> {
	value: values.Value<Type>;
	/** For the docs: a value, and what it means. */
	doc: readonly [example: string, meaning: string];
	/** without it: the style */
	part?: Part;
	controls?: readonly Control[];
}

interface Ranged extends Pick<Parameter<number>, 'doc' | 'part'>, Pick<Slider, 'folder' | 'label' | 'range' | 'step'> {
	initial: number;
	enabled?: Slider['enabled'];
}

/** A number with a slider over its whole range; whole numbers where the step is 1. */
export function ranged(name: NumberName, { doc, part, initial, ...control }: Ranged): Parameter<number> {
	const value = control.step === 1 ? values.whole(control.range[1]) : values.number(...control.range);
	return { value, doc, part, controls: [sliderOf(name, initial, control)] };
}
