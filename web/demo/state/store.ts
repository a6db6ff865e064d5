/** The store: keeps the view, and is its only writer. */

import type { View } from './view.ts';

/** Called after a change, with the view and the names of the values that changed. */
export type Listener = (view: View, changed: readonly (keyof View)[]) => void;

export class Store {
	#view: View;
	readonly #listeners = new Set<Listener>();

	constructor(view: View) {
		this.#view = Object.freeze({ ...view });
	}

	get(): View {
		return this.#view;
	}

	/** Changes the given values; undefined leaves one to the page. Equal values change nothing. */
	change(patch: Partial<View>): void {
		const names = Object.keys(patch) as (keyof View)[];
		const changed = names.filter((name) => !isEqual(this.#view[name], patch[name]));
		if (changed.length === 0) return;
		this.#view = Object.freeze({ ...this.#view, ...patch });
		for (const listener of this.#listeners) listener(this.#view, changed);
	}

	/** @returns ends the subscription */
	subscribe(listener: Listener): () => void {
		this.#listeners.add(listener);
		return () => this.#listeners.delete(listener);
	}
}

/** Equality of two values of a view: primitives, and flat arrays and objects of them. */
function isEqual(a: unknown, b: unknown): boolean {
	if (typeof a !== 'object' || typeof b !== 'object' || !a || !b) return a === b;
	const [left, right] = [Object.entries(a), Object.entries(b)];
	return left.length === right.length && left.every(([name, value]) => (b as Record<string, unknown>)[name] === value);
}
