/**
 * `npm run colours [-- --presets NAME,... --bodies NAME,... --json FILE]`: colours of lit fur on the page at its default
 * lamp, for every preset: hue and saturation of the mean, the share of pixels that clip, and on the sphere the distance to
 * the pelt's swatch under the same light. The truth beside the hues: `npm run verify -- DIR --colour`.
 */
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { browserArgs, ensureBrowser } from '../browser.mjs';
import { ensureNode, ensurePython, runFurbake } from '../environment.mjs';
import { command, Failure, root, say } from '../process.mjs';
import { serve } from '../site/vite.mjs';
import { clipped, deltaE, hueOf, litFur, meanColour, middleDisc } from './colour.mjs';
import { readOptions, writeFigures } from './measure.mjs';
import { table } from './table.mjs';

/** @import { Page } from '@playwright/test' */
/** @import { Colour, Pixels } from './colour.mjs' */

const models = join(root, 'public', 'models');
/** @type {{ name: string, pelt?: string }[]} */
const listed = JSON.parse(readFileSync(join(models, 'models.json'), 'utf8'));
const PELTS = listed.flatMap(({ name, pelt }) => (pelt && name === `pelt-${pelt}` ? [pelt] : []));
const BODIES = ['sphere', 'bunny'];
const VIEWPORT = { width: 360, height: 300 };
/** Milliseconds per picture, enough for software rendering. */
const PATIENCE = 300_000;
/** Any colour that no fur has. */
const OTHER = '0000ff,0000ff';
/** Part of the sphere's picture that is seen from straight above, about. */
const FACING = 0.2;
/** Lamps of equal height from all sides, since hairs lean another way on the sphere than on the swatch. */
const LAMPS = ['0.6,0,0.8', '0,0.6,0.8', '-0.6,0,0.8', '0,-0.6,0.8'];

/** @param {Colour[]} colours; @returns {Colour} */
function meanOf(colours) {
	const [red, green, blue] = [0, 1, 2].map((c) => colours.reduce((sum, one) => sum + one[c], 0) / colours.length);
	return [red, green, blue];
}

/** @param {string} text of an option; @param {string[]} known; @param {string} name */
function listOf(text, known, name) {
	const names = text.split(',');
	for (const one of names)
		if (!known.includes(one)) throw new Failure(`--${name}: got ${one}, expected some of ${known.join(', ')}`);
	return names;
}

/** @param {string} file; @returns {Promise<Pixels>} */
async function pixelsOf(file) {
	const { decode } = await import('fast-png');
	return decode(readFileSync(file));
}

/** @param {Page} page; @param {string} address; @returns {Promise<Pixels>} */
async function shown(page, address) {
	const { decode } = await import('fast-png');
	await page.goto(address);
	await page.waitForFunction("document.documentElement.dataset.state !== 'loading'", null, { timeout: PATIENCE });
	return decode(await page.screenshot({ timeout: PATIENCE }));
}

/** Distance of sphere and swatch. @param {Page} page; @param {string} site; @param {string} preset; @param {string} folder */
async function toSwatch(page, site, preset, folder) {
	const pelt = join(models, `pelt-${preset}`);
	const spheres = [];
	const swatches = [];
	for (const [i, lamp] of LAMPS.entries()) {
		const file = join(folder, `${preset}${i}.png`);
		if ((await runFurbake(['swatch', pelt, `--light=${lamp}`, '-o', file, '--quiet'])) !== 0 || !existsSync(file))
			throw new Failure(`colours: no swatch of ${pelt}`);
		const swatch = await pixelsOf(file);
		swatches.push(meanColour(swatch, middleDisc(swatch, 1)));
		const sphere = await shown(page, `${site}?model=sphere&preset=${preset}&light=${lamp}&camera=0,0,1&still=1&ui=0`);
		spheres.push(meanColour(sphere, middleDisc(sphere, FACING)));
	}
	return deltaE(meanOf(spheres), meanOf(swatches));
}

await command(async () => {
	const values = readOptions({
		presets: { type: 'string', default: PELTS.join(',') },
		bodies: { type: 'string', default: BODIES.join(',') },
		json: { type: 'string' },
	});
	const presets = listOf(values.presets, PELTS, 'presets');
	const bodies = listOf(values.bodies, BODIES, 'bodies');
	await ensurePython();
	await ensureNode();
	const { chromium } = await import('@playwright/test');
	const server = await serve();
	const browser = await chromium.launch({ executablePath: await ensureBrowser(), args: browserArgs });
	const folder = mkdtempSync(join(tmpdir(), 'furbake-colours-'));
	const figures = [];
	try {
		const page = await browser.newPage({ viewport: VIEWPORT });
		for (const preset of presets)
			for (const body of bodies) {
				say(`${preset} on ${body}`);
				const view = `${server.url}?model=${body}&preset=${preset}&still=1&ui=0`;
				const picture = await shown(page, view);
				const fur = litFur(picture, await shown(page, `${view}&colour=${OTHER}`));
				const swatch = body === 'sphere' ? await toSwatch(page, server.url, preset, folder) : undefined;
				const mean = hueOf(meanColour(picture, fur));
				figures.push({ preset, body, ...mean, clipped: clipped(picture, fur), swatch });
			}
	} finally {
		rmSync(folder, { recursive: true, force: true });
		await browser.close();
		await server.close();
	}
	const rows = figures.map(({ preset, body, hue, saturation, clipped, swatch }) => [
		`${preset} on ${body}`,
		`${hue.toFixed(1)} degrees`,
		saturation.toFixed(3),
		`${(100 * clipped).toFixed(2)} %`,
		swatch === undefined ? '' : swatch.toFixed(1),
	]);
	console.log(table([['lit fur of', 'hue', 'saturation', 'clipped', 'ΔE to its swatch'], ...rows]));
	writeFigures(values.json, figures);
});
