/**
 * Pictures of a baked folder's model from four sides, for `furbake report`: `sides.mjs MODEL OUT SIZE BACKDROP` writes
 * OUT/SIDE.jpg. Installs nothing.
 */
import { writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { findBrowser } from '../browser.mjs';
import { nodeIsInstalled } from '../environment.mjs';
import { command, Failure, say } from '../process.mjs';
import { inPage } from './measure.mjs';

await command(async () => {
	const [model, out, size, backdrop] = process.argv.slice(2);
	if (!nodeIsInstalled()) throw new Failure('the packages of the page are not installed (npm ci)');
	if (!(await findBrowser())) throw new Failure('no Chromium or Chrome found');
	/** @type {Record<string, string>} */
	const pictures = await inPage(resolve(model), '/measure/sides.ts', (page) =>
		page.evaluate(`loaded.drawSides('/baked/model.gltf', ${Number(size)}, ${JSON.stringify(backdrop)})`),
	);
	for (const [side, address] of Object.entries(pictures))
		writeFileSync(join(out, `${side}.jpg`), Buffer.from(address.split(',')[1], 'base64'));
	say('page 1/1');
});
