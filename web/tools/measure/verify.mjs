/**
 * `npm run verify -- DIR [options]`: compares the body of a baked folder, path-traced and as drawn by the page. Equal
 * to `furbake verify DIR --body`, which draws the page's part by this command's `--job FOLDER`.
 *
 * FOLDER has job.json (`BodyJob` of measure/bodyJob.ts) and the model in baked/; every picture is written beside them as raw
 * 32-bit floats, little-endian, rows from the bottom: CELL.METHOD.f32 and VIEW.features.f32 of two numbers a pixel,
 * VIEW.normals.f32 of four.
 */
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { ensureNode, ensurePython, runFurbake } from '../environment.mjs';
import { command, Failure, say } from '../process.mjs';
import { folderOf, inPage } from './measure.mjs';

/** @import { BodyJob } from '../../measure/bodyJob.ts' */

/** @param {string} folder */
async function drawJob(folder) {
	/** @type {BodyJob} */
	const job = JSON.parse(readFileSync(join(folder, 'job.json'), 'utf8'));
	await inPage(join(folder, 'baked'), '/measure/body.ts', async (page) => {
		/** @param {string} call of the body; @param {string} name of the file */
		const write = async (call, name) => {
			/** @type {string} */
			const text = await page.evaluate(`loaded.encoded(body.${call})`);
			writeFileSync(join(folder, `${name}.f32`), Buffer.from(text, 'base64'));
		};
		await page.evaluate(
			`loaded.openBody('/baked/model.gltf', ${JSON.stringify(job)}).then((body) => { globalThis.body = body; })`,
		);
		const views = new Set();
		for (const [i, { name, view }] of job.cells.entries()) {
			if (!views.has(view)) {
				await write(`normals(${i})`, `${view}.normals`);
				await write(`features(${i})`, `${view}.features`);
			}
			views.add(view);
			for (const method of job.methods) await write(`draw(${i}, '${method}')`, `${name}.${method}`);
			say(`page ${i + 1}/${job.cells.length + job.passes}`);
		}
		for (let number = 0; number < job.passes; number++) {
			await page.evaluate(`body.addPass(${number})`);
			say(`page ${job.cells.length + number + 1}/${job.cells.length + job.passes}`);
		}
		if (job.passes > 0)
			for (const [i, { name }] of job.cells.entries()) await write(`composite(${i})`, `${name}.samples`);
	});
}

await command(async () => {
	const [first, ...rest] = process.argv.slice(2);
	if (first === '--job') {
		await ensureNode();
		return drawJob(rest[0] ?? '');
	}
	if (!first || first.startsWith('-'))
		throw new Failure(`verify: got ${first ?? 'nothing'}, expected a folder in public/models or a baked one`);
	await ensurePython();
	await ensureNode();
	return runFurbake(['verify', folderOf(first), '--body', ...rest], { cwd: process.env.INIT_CWD });
});
