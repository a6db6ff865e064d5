/**
 * `npm run motion [-- --model NAME|FOLDER --json FILE]`: cost of moving fur per frame, with springs on the CPU and on
 * the GPU, in gusty wind, and asleep.
 */
import { basename } from 'node:path';
import { command, say } from '../process.mjs';
import { folderOf, inPage, readOptions, writeFigures } from './measure.mjs';
import { table } from './table.mjs';

/** @import { MotionFigures } from '../../measure/figures.ts' */

const options = /** @type {const} */ ({ model: { type: 'string', default: 'bunny' }, json: { type: 'string' } });

const NAMES = {
	without: 'no motion',
	asleep: 'asleep',
	cpu: 'wind, springs on the CPU',
	gpu: 'wind, springs on the GPU',
};

await command(async () => {
	const values = readOptions(options);
	const folder = folderOf(values.model);
	say(`measuring ${basename(folder)}; software rendering takes a minute or two`);
	/** @type {MotionFigures} As text, since it calls functions in the page. */
	const figures = await inPage(folder, '/measure/motion.ts', (page) =>
		page.evaluate("loaded.measureMotion('/baked/model.gltf')"),
	);
	const { width, height, shells, faces, follicles, costs } = figures;
	const rows = costs.map(({ mode, processor, frame, ratio, script, script95 }) => [
		// Springs stay on the CPU where the GPU can't take over.
		mode === 'gpu' && processor !== 'gpu' ? `${NAMES.gpu} (not there: on the CPU)` : NAMES[mode],
		`${frame.toFixed(1)} ms`,
		`x ${ratio.toFixed(3)}`,
		`${script.toFixed(2)} ms`,
		`${script95.toFixed(2)} ms`,
	]);
	console.log(`${basename(folder)}, ${width} x ${height} pixels, ${shells.toFixed(1)} shells, ${faces} faces, ${follicles} follicles

Frame time, springs included, finished by readPixels; median of rounds and of their ratio to frames without motion (in turn,
there and back). Of it the springs' script: median and 95th percentile of frames.

${table([['', 'frame', 'ratio', 'script', '95 %'], ...rows])}`);
	writeFigures(values.json, { model: basename(folder), ...figures });
});
