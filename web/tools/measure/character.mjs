/**
 * `npm run character -- --model FOLDER [--json FILE]`: cost per frame of a baked character that moves, over a statue of the
 * same vertices.
 */
import { basename } from 'node:path';
import { command, Failure, say } from '../process.mjs';
import { folderOf, inPage, readOptions, writeFigures } from './measure.mjs';
import { table } from './table.mjs';

/** @import { CharacterFigures } from '../../measure/figures.ts' */

const options = /** @type {const} */ ({ model: { type: 'string' }, json: { type: 'string' } });

const NAMES = {
	statue: 'statue',
	held: 'character in the same pose',
	moving: 'in its first clip',
	springs: 'and its hairs on springs',
};

await command(async () => {
	const values = readOptions(options);
	if (!values.model) throw new Failure('--model: got nothing, expected the folder of a baked character');
	const folder = folderOf(values.model);
	say(`measuring ${basename(folder)}; software rendering takes some minutes`);
	/** @type {CharacterFigures} As text, since it calls functions in the page. */
	const figures = await inPage(folder, '/measure/character.ts', (page) =>
		page.evaluate("loaded.measureCharacter('/baked/model.gltf')"),
	);
	const { width, height, joints, costs } = figures;
	const rows = costs.map(({ mode, frame, ratio, script }) => [
		NAMES[mode],
		`${frame.toFixed(1)} ms`,
		`x ${ratio.toFixed(3)}`,
		`${script.toFixed(2)} ms`,
	]);
	console.log(`${basename(folder)}, ${width} x ${height} pixels, ${joints} joints

Frame time finished by readPixels; median of rounds and of their ratio to the statue's frames (in turn, there and back). Of it
the script of clip and springs.

${table([['', 'frame', 'ratio', 'script'], ...rows])}`);
	writeFigures(values.json, { model: basename(folder), ...figures });
});
