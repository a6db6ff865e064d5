/** Plain comments: they open with a noun or an imperative, not with a clause about one. */

import { readdirSync, readFileSync } from 'node:fs';
import { extname, join, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';

const web = fileURLToPath(new URL('../../web/', import.meta.url));

/** Checked folders of web/. */
const FOLDERS = ['fur', 'learn', 'bench', 'page', 'measure', 'tools', 'example', 'demo'];
const KINDS = ['.ts', '.glsl', '.mjs', '.css'];

/** Openings that a noun or an imperative replaces: "Options of X", not "What X may be told". */
const FORBIDDEN = /^(of|what|has|have|whom|whose|who|somebody|whether somebody|to be called|for what nobody|as of)\b/i;

/** Files of a folder, except generated and third-party ones. */
const filesOf = (folder: string) =>
	readdirSync(join(web, folder), { recursive: true, encoding: 'utf8' })
		.map((path) => join(folder, path).split(sep).join('/'))
		.filter((path) => KINDS.includes(extname(path)));

/** First words of every comment: block, own lines together, or at a line's end. */
function openings(source: string): string[] {
	const found: string[] = [];
	let before = false;
	for (const line of source.split('\n')) {
		const own = /^\s*\/\/\s*(.*)/.exec(line)?.[1];
		const opening =
			own ??
			/\/\*+\s*([^\s*].*)/.exec(line)?.[1] ??
			/[\s;,{]\/\/ (.*)/.exec(line)?.[1] ??
			/^\s*\/\*\*?$/.exec(line)?.[0];
		if (opening !== undefined && !(own !== undefined && before)) found.push(opening);
		else if (/^\s*\/\*\*?$/.test(found.at(-1) ?? '') && /^\s*\* \S/.test(line))
			found[found.length - 1] = line.replace(/^\s*\* /, '');
		before = own !== undefined;
	}
	return found.map((opening) => opening.replace(/^`npm run[^`]*`: /, ''));
}

it('finds the opening of every kind of comment', () => {
	expect(openings('/** One. */\n/**\n * Two\n * lines.\n */\n// Three\n// lines\nx; // four\n')).toEqual([
		'One. */',
		'Two',
		'Three',
		'four',
	]);
});

it.each(FOLDERS)('comments in web/%s open with a noun or an imperative', (folder) => {
	const found = filesOf(folder).flatMap((path) =>
		openings(readFileSync(join(web, path), 'utf8'))
			.filter((opening) => FORBIDDEN.test(opening))
			.map((opening) => `${path}: ${opening}`),
	);
	expect(found).toEqual([]);
});
