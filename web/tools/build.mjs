/** `npm run build`: the static site in dist/, with relative paths. */
import { ensureNode } from './environment.mjs';
import { command } from './process.mjs';
import { vite } from './site/vite.mjs';

await command(async () => {
	await ensureNode();
	return vite(['build', ...process.argv.slice(2)]);
});
