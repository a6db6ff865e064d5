/**
 * `node web/tools/site/places.mjs`: packs the places of `<fur-view>` from their panoramas into `web/view/places/table.json`. Run it
 * after a change of how places are lit.
 */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { runnerImport } from 'vite';
import { command, root, say } from '../process.mjs';

const folder = join(root, 'web', 'view', 'places');

await command(async () => {
	const { module } = await runnerImport(join(folder, 'packed.ts'), { configFile: false, logLevel: 'error' });
	const file = join(folder, 'table.json');
	writeFileSync(file, `${JSON.stringify(module.default, null, '\t')}\n`);
	say(`${file} is written`);
	return 0;
});
