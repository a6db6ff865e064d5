/** Two states around a wetness, and their shares. */

export interface Mixture {
	/** Index of the drier state; the wetter is the next. */
	drier: number;
	/** Share of the wetter state, 0..1. */
	share: number;
}

/** @param wetnesses of the states, rising from 0, two at least */
export function mixtureOf(wetnesses: readonly number[], wetness: number): Mixture {
	const wetter = wetnesses.findIndex((own, i) => i > 0 && own >= wetness);
	const drier = (wetter < 0 ? wetnesses.length - 1 : wetter) - 1;
	const [from, to] = [wetnesses[drier] ?? 0, wetnesses[drier + 1] ?? 1];
	return { drier, share: Math.min((wetness - from) / (to - from), 1) };
}
