/** What was wrong with an address, in the visitor's language. */

import { methods, type Problem } from './address.ts';
import { environments } from './environments.ts';
import { words } from './words/index.ts';

/** Names that the address knows where words would list them. */
const names: Record<string, string> = {
	method: methods.join(', '),
	split: methods.join(', '),
	env: ['none', ...environments].join(', '),
};

export function explain({ name, text, expected }: Problem): string {
	if (!expected) return words.unknownParameter(name);
	const wanted = words.expected[expected];
	return words.badValue(`${name}=${text}`, typeof wanted === 'string' ? wanted : wanted(names[expected] ?? ''));
}
