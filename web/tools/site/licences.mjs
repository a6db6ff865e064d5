/**
 * Licence texts of everything that a build holds, in its `licenses.md`. Vite lists the packages; texts that lie elsewhere are
 * added here, and a build without one of them is refused.
 */
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Failure, root } from '../process.mjs';

/** @import { Plugin } from 'vite' */

/**
 * @typedef {object} Package as vite lists it
 * @property {string} name
 * @property {string} version
 * @property {string} [identifier] of its licence
 * @property {string} [text] of its licence, if the package holds it
 */

const LISTED = 'licenses.json';

/** @param {string} file */
const notice = (file) => readFileSync(new URL(`./notices/${file}`, import.meta.url), 'utf8').trim();

/**
 * @param {Package} entry
 * @param {string} [author] of the package, as its package.json says
 * @returns {string} text of the licence: the package's own, or that of MIT where it only names this licence
 */
export function licenceText({ name, version, identifier, text }, author) {
	if (text) return text;
	const holder = author?.replace(/\s*[<(].*/, '');
	if (identifier === 'MIT' && holder) return notice('MIT.txt').replace('{author}', holder);
	throw new Failure(
		`${name} ${version}: no licence text in the package (${identifier ?? 'no licence named'}), expected one to bundle it`,
	);
}

/**
 * @param {string} source a bundled module
 * @returns {string[]} comments in it that hold a copyright and its terms
 */
export function noticesIn(source) {
	const comments = source.match(/\/\*[\s\S]*?\*\/|(?:^[ \t]*(?:\/\/.*)?\r?\n)+/gm) ?? [];
	return comments
		.filter((comment) => /copyright/i.test(comment) && /redistribut|permission|warrant/i.test(comment))
		.map((comment) => comment.replace(/^[ \t]*(?:\/\/[ \t]?|\/?\*+\/?[ \t]?)+/gm, '').trim());
}

/** @param {string} name of a package; @returns {string | undefined} its author */
function authorOf(name) {
	const { author } = JSON.parse(readFileSync(join(root, 'node_modules', name, 'package.json'), 'utf8'));
	return typeof author === 'object' ? author.name : author;
}

/**
 * Writes the licence texts beside what is built.
 *
 * @param {string} [written] name of their file
 * @returns {Plugin}
 */
export function licencesPlugin(written = 'licenses.md') {
	return {
		name: 'furbake-licences',
		apply: 'build',
		config: () => ({ build: { license: { fileName: LISTED } } }),
		generateBundle: {
			order: 'post',
			handler(_, bundle) {
				const list = bundle[LISTED];
				if (list?.type !== 'asset') throw new Failure(`${LISTED}: not written by vite, expected its list of packages`);
				/** @type {Package[]} */
				const packages = JSON.parse(`${list.source}`);
				const parts = packages.map((entry) => {
					const title = `${entry.name} - ${entry.version}${entry.identifier ? ` (${entry.identifier})` : ''}`;
					return { title, text: licenceText(entry, authorOf(entry.name)) };
				});
				const files = Object.values(bundle);
				const modules = files.flatMap((file) => (file.type === 'chunk' ? file.moduleIds : []));
				for (const path of new Set(modules.map((id) => id.replace(/\?.*/, '')))) {
					const [, name] = /\/node_modules\/((?!.*\/node_modules\/).*)/.exec(path.replaceAll('\\', '/')) ?? [];
					if (!name || !existsSync(path)) continue;
					for (const text of noticesIn(readFileSync(path, 'utf8'))) parts.push({ title: name, text });
				}
				if (files.some(({ fileName }) => /KaTeX_[\w-]+\.woff2$/.test(fileName)))
					parts.push({ title: 'Fonts of katex (OFL-1.1)', text: notice('katex-fonts.txt') });
				delete bundle[LISTED];
				this.emitFile({ type: 'asset', fileName: written, source: licenceList(parts) });
			},
		},
	};
}

/** @param {{ title: string, text: string }[]} parts; @returns {string} Markdown */
export function licenceList(parts) {
	const sections = parts.map(({ title, text }) => `## ${title}\n\n${text.trim()}\n`);
	return `# Licenses\n\nLicenses of what is bundled here:\n\n${sections.join('\n')}`;
}
