/**
 * `npm run furbake -- ARGS` and `npm run bake -- MODEL ...`: the command `furbake` in the project's own environment.
 * Paths are as the caller sees them; the exit code and both outputs are furbake's own.
 */
import { ensurePython, runFurbake } from './environment.mjs';
import { command } from './process.mjs';

await command(async () => {
	await ensurePython();
	return runFurbake(process.argv.slice(2), { cwd: process.env.INIT_CWD });
});
