/**
 * `npm run furbake -- ARGS` and `npm run bake -- MODEL ...`: the command `furbake` in the project's own environment.
 * Paths are as the caller sees them; the exit code and both outputs are furbake's own.
 */
import { ensurePython, runFurbake } from './environment.mjs';
import { command, Failure } from './process.mjs';

await command(async () => {
	const args = process.argv.slice(2);
	// npm takes options before -- for its own and leaves their values.
	if (process.env.npm_lifecycle_event === 'bake' && args.length > 2 && !args.some((arg) => arg.startsWith('-')))
		throw new Failure('bake: got no options, expected -- before them: npm run bake -- MODEL -o DIR');
	await ensurePython();
	return runFurbake(args, { cwd: process.env.INIT_CWD });
});
