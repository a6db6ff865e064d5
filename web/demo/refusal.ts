/** A reason why something is not shown, in whatever language the page speaks. */

import { en, type Refusals } from './words/refusals.en.ts';

export class Refused extends Error {
	override readonly name = 'Refused';

	/** @param say picks the reason out of a language's, and fills in its values */
	constructor(readonly say: (words: Refusals) => string) {
		super(say(en));
	}
}
