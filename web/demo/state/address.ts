/**
 * The view as a link: `?model=bunny&preset=fox&method=ptm&split=lengyel,0.5&wind=0.4,90&still=1`. The table of parameters
 * says what each of them means.
 */

import { NAMES, type Parameter, parameters } from './parameters.ts';
import type { Store } from './store.ts';
import type { Kind } from './values.ts';
import { FIRST_VIEW, type View } from './view.ts';

/** Milliseconds between a change and the address that has it: browsers allow few writes a second. */
const DELAY = 400;

/** A parameter that was ignored; `expected` is missing for an unknown name. */
export interface Problem {
	name: string;
	text: string;
	expected?: Kind;
}

/**
 * @param search the address's query, with or without its question mark
 * @returns the view, and each parameter that was ignored
 */
export function parseAddress(search: string): { view: View; problems: Problem[] } {
	const view: View = { ...FIRST_VIEW };
	const problems: Problem[] = [];
	for (const [name, text] of new URLSearchParams(search)) {
		const known = NAMES.find((own) => own === name);
		const value = known && parameters[known].value.read(text);
		if (known && value !== undefined) Object.assign(view, { [known]: value });
		else problems.push({ name, text, ...(known && { expected: parameters[known].value.kind }) });
	}
	return { view, problems };
}

/** @returns the query with its question mark; empty for the page's own view */
export function formatAddress(view: View): string {
	const parts = NAMES.flatMap((name) => {
		const value = view[name];
		if (value === undefined || value === FIRST_VIEW[name]) return [];
		return `${name}=${(parameters[name] as Parameter<unknown>).value.write(value)}`;
	});
	return parts.length ? `?${parts.join('&')}` : '';
}

/** Keeps the address bar in step with the view, from the next change on. */
export function followInAddressBar(store: Store): void {
	let timer: ReturnType<typeof setTimeout> | undefined;
	store.subscribe((view) => {
		clearTimeout(timer);
		timer = setTimeout(() => history.replaceState(null, '', formatAddress(view) || location.pathname), DELAY);
	});
}
