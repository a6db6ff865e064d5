/** Calm: nothing moves by itself, as the reader's machine prefers, or as the reader asks by a button. */

export class Calm {
	#on: boolean;
	readonly #listeners = new Set<(on: boolean) => void>();

	/**
	 * @param always whether the page is to stay calm, as for a picture of it
	 * @param preference media query for less motion, followed whenever it changes
	 */
	constructor(
		readonly always: boolean,
		preference: Pick<MediaQueryList, 'matches' | 'addEventListener'>,
	) {
		this.#on = always || preference.matches;
		preference.addEventListener('change', () => {
			this.on = preference.matches;
		});
	}

	get on(): boolean {
		return this.#on;
	}

	set on(on: boolean) {
		const wanted = on || this.always;
		if (wanted === this.#on) return;
		this.#on = wanted;
		for (const listener of this.#listeners) listener(wanted);
	}

	/** Calls back now and on every change. */
	listen(listener: (on: boolean) => void): void {
		this.#listeners.add(listener);
		listener(this.#on);
	}
}
