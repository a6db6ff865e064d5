/** Explains a problem of an address in the page's language. */

import type { Problem } from '../state/address.ts';
import { parameters } from '../state/parameters.ts';
import type { View } from '../state/view.ts';
import { words } from '../words/index.ts';

export function explain({ name, text, expected }: Problem): string {
	if (!expected) return words.unknownParameter(name);
	const wanted: string | ((...limits: string[]) => string) = words.expected[expected];
	const { limits } = parameters[name as keyof View].value;
	return words.badValue(`${name}=${text}`, typeof wanted === 'string' ? wanted : wanted(...limits));
}
