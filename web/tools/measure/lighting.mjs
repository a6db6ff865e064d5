/**
 * `npm run environment [-- --model NAME|FOLDER --sky NAME,... --json FILE]`: error of a baked model under the light moments
 * of a place against the same model under a thousand lamps that stand for the place.
 */
import { basename } from 'node:path';
import { ensureNode } from '../environment.mjs';
import { command, Failure, say } from '../process.mjs';
import { folderOf, inPage, readOptions, writeFigures } from './measure.mjs';
import { table } from './table.mjs';

/** @import { EnvironmentFigures } from '../../measure/figures.ts' */

const options = /** @type {const} */ ({
	model: { type: 'string', default: 'bunny' },
	sky: { type: 'string', default: 'studio,city,sky,sunset,forest' },
	json: { type: 'string' },
});

/** @param {string} name of a picture in @pmndrs/assets/hdri; @returns {Promise<Buffer>} the EXR file */
async function picture(name) {
	const found = /^[a-z]+$/.test(name)
		? await import(`@pmndrs/assets/hdri/${name}.exr.js`).catch(() => undefined)
		: undefined;
	if (!found) throw new Failure(`--sky: got ${name}, expected names of pictures in node_modules/@pmndrs/assets/hdri`);
	return Buffer.from(found.default.slice(found.default.indexOf(',') + 1), 'base64');
}

const percent = (/** @type {number} */ share) => `${(100 * share).toFixed(2)} %`;

/** @param {Record<string, EnvironmentFigures>} figures; @returns {string} */
function report(figures) {
	const heads = ['', 'view', 'order 2', 'bias', '+ 1 lamp', 'bias', '+ 2 lamps', 'bias', 'light in lamps'];
	const rows = Object.entries(figures).flatMap(([name, { views, shares }]) =>
		views.map((view) => [
			name,
			view.name,
			...view.moments.flatMap(({ rmse, bias }) => [percent(rmse), percent(bias)]),
			shares.map((share) => percent(share)).join(', ') || '-',
		]),
	);
	return table([heads, ...rows]);
}

await command(async () => {
	const values = readOptions(options);
	const folder = folderOf(values.model);
	const names = values.sky.split(',');
	await ensureNode();
	const pictures = await Promise.all(names.map(picture));
	say(`measuring ${basename(folder)}; software rendering takes a minute or more for each of ${names.join(', ')}`);
	const figures = await inPage(folder, '/measure/environment.ts', async (page) => {
		/** @type {Record<string, EnvironmentFigures>} */
		const measured = {};
		for (const [i, name] of names.entries()) {
			await page.route(`**/sky/${name}.exr`, (route) => route.fulfill({ body: pictures[i] }));
			// As text, since it calls functions in the page.
			measured[name] = await page.evaluate(`loaded.measureEnvironment('/baked/model.gltf', '/sky/${name}.exr')`);
		}
		return measured;
	});
	const [{ width, height, lamps, shells }] = Object.values(figures);
	console.log(`${basename(folder)}, ${width} x ${height} pixels, ${shells} shells: fur alone, linear light, wholly open to the sky

Root mean square of the difference to the same fur under ${lamps} lamps or a few less, over the pixels that fur covers at
least half, in shares of their mean. Harmonics of order 2 alone, and with the lamps that stand out of the picture apart.

${report(figures)}`);
	writeFigures(values.json, { model: basename(folder), skies: figures });
});
