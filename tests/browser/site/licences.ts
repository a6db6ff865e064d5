/** Texts of a `licenses.md` by the name of each part, without versions and identifiers. */
export function licencesIn(markdown: string): Map<string, string> {
	const parts = markdown.split(/^## (.+)$/m).slice(1);
	const names = parts.filter((_, i) => i % 2 === 0).map((title) => title.replace(/ - \d.*| \(.*/, ''));
	return new Map(names.map((name, i) => [name, parts[2 * i + 1] ?? '']));
}
