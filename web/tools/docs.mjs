/**
 * `npm run docs`: the docs in dist/docs/, and the library's reference by TypeDoc in dist/docs/reference/, beside the site that
 * is there. Warnings fail: every public name is documented.
 */
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { ensureNode } from './environment.mjs';
import { command, Failure, root, run, say } from './process.mjs';
import { licenceList } from './site/licences.mjs';

const docs = join(root, 'dist', 'docs');
const folder = join(docs, 'reference');
const SCRIPT = 'assets/first.js';

/** @param {string} name of a package */
const licenceOf = (name) => readFileSync(join(root, 'node_modules', name, 'LICENSE'), 'utf8');

/** Links of TypeDoc's header, by their words. @type {{ navigationLinks: Record<string, string> }} */
const { navigationLinks } = JSON.parse(readFileSync(join(root, 'web', 'typedoc.json'), 'utf8'));

/**
 * Moves the inline script of TypeDoc's pages to a file, as the site's policy requires.
 *
 * @param {string} html
 * @param {Set<string>} scripts takes the removed scripts
 */
function withoutScript(html, scripts) {
	const up = /<html [^>]*data-base="([^"]*)"/.exec(html)?.[1] ?? './';
	return html.replace(/<script>([^<]*)<\/script>/g, (_, script) => {
		scripts.add(script);
		return `<script src="${up}${SCRIPT}"></script>`;
	});
}

/**
 * TypeDoc writes links to other pages of the site into all of its folders as they are: they are seen from its first page.
 *
 * @param {string} html
 */
function withSiteLinks(html) {
	const up = /<html [^>]*data-base="([^"]*)"/.exec(html)?.[1] ?? './';
	return Object.entries(navigationLinks).reduce(
		(page, [name, href]) => page.replaceAll(new RegExp(`(<a href=")${href}("[^>]*>${name}<)`, 'g'), `$1${up}${href}$2`),
		html,
	);
}

await command(async () => {
	await ensureNode();
	const typedoc = join(root, 'node_modules', 'typedoc', 'bin', 'typedoc');
	const failed = await run(process.execPath, [typedoc, '--options', join('web', 'typedoc.json'), '--out', folder]);
	if (failed !== 0) return failed;
	/** @type {Set<string>} */
	const scripts = new Set();
	for (const file of readdirSync(folder, { recursive: true, encoding: 'utf8' })) {
		if (!file.endsWith('.html')) continue;
		const path = join(folder, file);
		writeFileSync(path, withSiteLinks(withoutScript(readFileSync(path, 'utf8'), scripts)));
	}
	writeFileSync(join(folder, ...SCRIPT.split('/')), [...scripts].join('\n'));
	const main = join(folder, 'assets', 'main.js');
	const code = readFileSync(main, 'utf8');
	// The style element for filters, which are turned off, would violate the policy even when empty.
	const patched = code.replace('createElement("style")', 'createElement("template")');
	if (patched === code || patched.includes('createElement("style")'))
		throw new Failure("TypeDoc's main.js: expected one style element made by it, and that for its filters");
	writeFileSync(main, patched);
	// Its search is lunr's.
	const bundled = ['typedoc', 'lunr'].map((title) => ({ title, text: licenceOf(title) }));
	writeFileSync(join(folder, 'licenses.md'), licenceList(bundled));
	// Not before it is installed.
	const { guide } = await import('./site/guide.mjs');
	for (const [file, text] of guide({ reference: true })) writeFileSync(join(docs, file), text);
	say('the docs are dist/docs/index.html, the reference is dist/docs/reference/index.html');
	return 0;
});
