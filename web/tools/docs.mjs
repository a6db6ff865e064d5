/**
 * `npm run docs`: the library's reference by TypeDoc in dist/docs/, beside the site that is there. Warnings fail: what is
 * public is documented.
 */
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { ensureNode } from './environment.mjs';
import { command, Failure, root, run, say } from './process.mjs';

const folder = join(root, 'dist', 'docs');
const SCRIPT = 'assets/first.js';

/**
 * TypeDoc's pages begin with a script of their own, the same in all: the site's policy wants it in a file.
 *
 * @param {string} html
 * @param {Set<string>} scripts what has stood there
 */
function withoutScript(html, scripts) {
	const up = /<html [^>]*data-base="([^"]*)"/.exec(html)?.[1] ?? './';
	return html.replace(/<script>([^<]*)<\/script>/g, (_, script) => {
		scripts.add(script);
		return `<script src="${up}${SCRIPT}"></script>`;
	});
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
		writeFileSync(path, withoutScript(readFileSync(path, 'utf8'), scripts));
	}
	writeFileSync(join(folder, ...SCRIPT.split('/')), [...scripts].join('\n'));
	const main = join(folder, 'assets', 'main.js');
	const code = readFileSync(main, 'utf8');
	// It would hold the rules of filters, which are turned off; even empty it is against the policy.
	const patched = code.replace('createElement("style")', 'createElement("template")');
	if (patched === code || patched.includes('createElement("style")'))
		throw new Failure("TypeDoc's main.js: expected one style element made by it, and that for its filters");
	writeFileSync(main, patched);
	say('the reference is dist/docs/index.html');
	return 0;
});
