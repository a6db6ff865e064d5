/** `npm run preview`: serves dist/ as a static host would, building it first where it is missing. */
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { ensureNode } from './environment.mjs';
import { command, root } from './process.mjs';
import { vite } from './site/vite.mjs';

await command(async () => {
	await ensureNode();
	if (!existsSync(join(root, 'dist', 'index.html'))) {
		const code = await vite(['build']);
		if (code !== 0) return code;
	}
	return vite(['preview', ...process.argv.slice(2)]);
});
