/** Reason why a model is not shown, in any language of the page. */

import { en, type Refusals } from '../words/refusals.en.ts';

export class Refused extends Error {
	override readonly name = 'Refused';

	/** @param say picks the sentence out of a language's, and fills in its values */
	constructor(readonly say: (words: Refusals) => string) {
		super(say(en));
	}
}
