/** Writes the table of address parameters into its page of the docs. */
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './process.mjs';

const page = join(root, 'web', 'docs', 'address.md');

/** @returns whether the page had the table of today; `write`: it has from now on */
export async function checkAddressTable(/** @type {boolean} */ write) {
	// Not before it is installed.
	const { runnerImport } = await import('vite');
	/** @type {{ module: { withAddressTable(page: string): string } }} */
	const { module } = await runnerImport(join(root, 'web', 'demo', 'state', 'docs.ts'));
	const before = readFileSync(page, 'utf8');
	const after = module.withAddressTable(before);
	if (write) writeFileSync(page, after);
	return before === after || write;
}
