/** Names of a model's clips. */

/**
 * Unique names, in order: a name that has been taken gets a number.
 *
 * @param clips with names that may be empty or repeated
 */
export function clipNames(clips: readonly { name: string }[]): string[] {
	const taken = new Set<string>();
	return clips.map(({ name }, i) => {
		const own = name || `clip ${i + 1}`;
		let unique = own;
		for (let n = 2; taken.has(unique); n++) unique = `${own} ${n}`;
		taken.add(unique);
		return unique;
	});
}
