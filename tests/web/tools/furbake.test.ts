/** The wrapper of the command says what npm does to options. */

import { spawnSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';

it('npm run bake without -- is told so', () => {
	const script = fileURLToPath(new URL('../../../web/tools/furbake.mjs', import.meta.url));
	const env = { ...process.env, npm_lifecycle_event: 'bake' };
	const { status, stderr } = spawnSync(process.execPath, [script, 'bake', 'my.glb', 'out'], { env, encoding: 'utf8' });
	expect(status).toBe(1);
	expect(stderr).toBe('furbake: bake: got no options, expected -- before them: npm run bake -- MODEL -o DIR\n');
});
