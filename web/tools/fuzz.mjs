/**
 * `npm run fuzz -- --minutes 30`: broken models and baked folders, read by the baker until the time is over.
 */
import { join } from 'node:path';
import { ensurePython, python } from './environment.mjs';
import { command, root, run } from './process.mjs';

await command(async () => {
	await ensurePython({ dev: true });
	return run(python, ['-m', 'fuzz', ...process.argv.slice(2)], { cwd: join(root, 'tests', 'baker') });
});
