/** What many timed frames say: medians, and ratios of rivals that took turns. */

/** @returns the middle value, or the mean of the two; NaN of none */
export function median(values: readonly number[]): number {
	const sorted = values.toSorted((a, b) => a - b);
	const middle = sorted.length / 2;
	return ((sorted[Math.ceil(middle) - 1] ?? Number.NaN) + (sorted[Math.floor(middle)] ?? Number.NaN)) / 2;
}

/**
 * The turns of a round: there and back, A B C C B A, so that a machine that gets slower or faster at an even pace is as
 * unfair to the first as to the last.
 */
export function thereAndBack<T>(rivals: readonly T[]): T[] {
	return [...rivals, ...rivals.toReversed()];
}

/** Of a rival, the mean of its two turns, for each round. */
export function perRound(turns: readonly number[]): number[] {
	return Array.from({ length: turns.length >> 1 }, (_, round) => {
		return ((turns[2 * round] ?? Number.NaN) + (turns[2 * round + 1] ?? Number.NaN)) / 2;
	});
}

/** Median over the rounds of one rival's time over another's, both as from `perRound`. */
export function ratio(rounds: readonly number[], base: readonly number[]): number {
	return median(rounds.map((time, round) => time / (base[round] ?? Number.NaN)));
}
