/** Command that bakes a file. */

/** @param path of the file; only its name is used, in quotes where a shell needs them */
export function bakeCommand(path: string): string {
	const file = path.split('/').at(-1) as string;
	const name =
		file
			.replace(/\.[^.]*$/, '')
			.replace(/[^\p{L}\p{N}_-]+/gu, '-')
			.replace(/^-+|-+$/g, '') || 'model';
	const quoted = /^[\w.][\w.-]*$/.test(file) ? file : `"${file.replace(/["$`\\]/g, '\\$&')}"`;
	return `npm run bake -- ${quoted} -o public/models/${name}`;
}
