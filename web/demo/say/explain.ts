/** Explains a problem of an address in the page's language. */

import type { Problem } from '../state/address.ts';
import { parameters } from '../state/parameters.ts';
import type { View } from '../state/view.ts';
import { words } from '../words/index.ts';

export function explain({ name, text, expected }: Problem): string {
	if (!expected) return words.unknownParameter(name);
	const wanted: string | ((...limits: string[]) => string) = words.expected[expected];
	const { value, doc } = parameters[name as keyof View];
	const said = typeof wanted === 'string' ? wanted : wanted(...value.limits);
	return words.badValue(`${name}=${text}`, said, doc[0]);
}
