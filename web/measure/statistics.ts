/** Statistics of timed frames: medians, and ratios of subjects that took turns. */

/** @returns the middle value, or the mean of the two; NaN of none */
export function median(values: readonly number[]): number {
	const sorted = values.toSorted((a, b) => a - b);
	const middle = sorted.length / 2;
	return ((sorted[Math.ceil(middle) - 1] ?? Number.NaN) + (sorted[Math.floor(middle)] ?? Number.NaN)) / 2;
}

/**
 * Turns of a round, there and back: A B C C B A. A machine that slows down or speeds up evenly favours none.
 */
export function thereAndBack<T>(subjects: readonly T[]): T[] {
	return [...subjects, ...subjects.toReversed()];
}

/** Mean of a subject's two turns in each round. */
export function perRound(turns: readonly number[]): number[] {
	return Array.from({ length: turns.length >> 1 }, (_, round) => {
		return ((turns[2 * round] ?? Number.NaN) + (turns[2 * round + 1] ?? Number.NaN)) / 2;
	});
}

/** Median over the rounds of one subject's time over another's, both as from `perRound`. */
export function ratio(rounds: readonly number[], base: readonly number[]): number {
	return median(rounds.map((time, round) => time / (base[round] ?? Number.NaN)));
}
