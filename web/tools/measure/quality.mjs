/**
 * `npm run quality [-- --model NAME|FOLDER --json FILE]`: error of a frame against one with 64 shells and 16 samples per
 * pixel, close up, whole and far away.
 */
import { basename } from 'node:path';
import { command, say } from '../process.mjs';
import { folderOf, inPage, readOptions, writeFigures } from './measure.mjs';
import { table } from './table.mjs';

/** @import { Quality } from '../../measure/figures.ts' */

const options = /** @type {const} */ ({ model: { type: 'string', default: 'bunny' }, json: { type: 'string' } });

await command(async () => {
	const values = readOptions(options);
	const folder = folderOf(values.model);
	say(`measuring ${basename(folder)}; software rendering takes a minute or two`);
	/** @type {Quality[]} As text, since it calls functions in the page. */
	const figures = await inPage(folder, '/measure/quality.ts', (page) =>
		page.evaluate("loaded.measureQuality('/baked/model.gltf')"),
	);
	const rows = figures.map(({ distance, azimuth, shells, psnr, brightness, pixels }) => [
		`${distance} x, ${((azimuth * 180) / Math.PI).toFixed(0)} degrees`,
		shells.toFixed(1),
		`${psnr.toFixed(1)} dB`,
		`${(100 * brightness).toFixed(1)} %`,
		`${pixels}`,
	]);
	console.log(`${basename(folder)}, as many shells as the frame needs, against 64 shells and 16 samples per pixel

${table([['distance, from', 'shells', 'PSNR', 'brightness', 'pixels'], ...rows])}`);
	writeFigures(values.json, { model: basename(folder), figures });
});
