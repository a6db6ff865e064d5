/**
 * `npm run blender [-- --out FOLDER]`: the extension for Blender as a zip, into `packages/` or the folder that is named.
 * `npm run blender -- --bpy`: Blender as a Python package, for the extension's tests: 0.4 GB in `baker/.bpy/`.
 */
import { mkdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { ensureBlender, ensureNode } from '../environment.mjs';
import { command, Failure, root, runAside, say } from '../process.mjs';

await command(async () => {
	const { values } = parseArgs({
		options: { out: { type: 'string', default: join(root, 'packages') }, bpy: { type: 'boolean', default: false } },
	});
	if (values.bpy) {
		await ensureBlender();
		return;
	}
	await ensureNode();
	const code = await runAside(process.execPath, [join(root, 'web', 'tools', 'library.mjs')]);
	if (code !== 0) throw new Failure(`npm run library failed with exit code ${code}`);
	// It needs packages that a new clone gets by `ensureNode`.
	const { packExtension } = await import('./extension.mjs');
	const folder = resolve(values.out);
	mkdirSync(folder, { recursive: true });
	say(packExtension(folder));
});
