/** The sphere on the page beside the swatch of its pelt. */
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { runFurbake } from '../environment.mjs';
import { Failure } from '../process.mjs';
import { deltaE, meanColour, middleDisc } from './colour.mjs';

/** @import { Page } from '@playwright/test' */
/** @import { Colour, Pixels } from './colour.mjs' */

/** Milliseconds per picture, enough for software rendering. */
const PATIENCE = 300_000;
/** Part of the sphere's picture that is seen from straight above, about. */
const FACING = 0.2;
/** Lamps of equal height from all sides, since hairs lean another way on the sphere than on the swatch. */
const LAMPS = ['0.6,0,0.8', '0,0.6,0.8', '-0.6,0,0.8', '0,-0.6,0.8'];

/** @param {Colour[]} colours; @returns {Colour} */
function meanOf(colours) {
	const [red, green, blue] = [0, 1, 2].map((c) => colours.reduce((sum, one) => sum + one[c], 0) / colours.length);
	return [red, green, blue];
}

/** @param {string} file; @returns {Promise<Pixels>} */
async function pixelsOf(file) {
	const { decode } = await import('fast-png');
	return decode(readFileSync(file));
}

/** Picture of the page at an address. @param {Page} page; @param {string} address; @returns {Promise<Pixels>} */
export async function shown(page, address) {
	const { decode } = await import('fast-png');
	await page.goto(address);
	await page.waitForSelector('html[data-state]:not([data-state=loading])', { state: 'attached', timeout: PATIENCE });
	return decode(await page.screenshot({ timeout: PATIENCE }));
}

/**
 * ΔE between the sphere on the page and the swatch of its pelt under the same lamps.
 *
 * @param {Page} page
 * @param {string} site where the demo is served, with a slash at its end
 * @param {string} pelt folder of the baked pelt
 * @param {string} preset its name
 * @param {string} folder for the swatches
 */
export async function toSwatch(page, site, pelt, preset, folder) {
	const spheres = [];
	const swatches = [];
	for (const [i, lamp] of LAMPS.entries()) {
		const file = join(folder, `${preset}${i}.png`);
		if ((await runFurbake(['swatch', pelt, `--light=${lamp}`, '-o', file, '--quiet'])) !== 0 || !existsSync(file))
			throw new Failure(`no swatch of ${pelt}`);
		const swatch = await pixelsOf(file);
		swatches.push(meanColour(swatch, middleDisc(swatch, 1)));
		const sphere = await shown(page, `${site}?model=sphere&preset=${preset}&light=${lamp}&camera=0,0,1&still=1&ui=0`);
		spheres.push(meanColour(sphere, middleDisc(sphere, FACING)));
	}
	return deltaE(meanOf(spheres), meanOf(swatches));
}
