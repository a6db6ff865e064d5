/**
 * `npm run colours [-- --presets NAME,... --bodies NAME,... --json FILE]`: colours of lit fur on the page at its default
 * lamp, for every preset: hue and saturation of the mean, the share of pixels that clip, and on the sphere the distance to
 * the pelt's swatch under the same light. The truth beside the hues: `npm run verify -- DIR --colour`.
 */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { browserArgs, ensureBrowser } from '../browser.mjs';
import { ensureNode, ensurePython } from '../environment.mjs';
import { command, Failure, root, say } from '../process.mjs';
import { serve } from '../site/vite.mjs';
import { clipped, hueOf, litFur, meanColour } from './colour.mjs';
import { readOptions, writeFigures } from './measure.mjs';
import { shown, toSwatch } from './swatch.mjs';
import { table } from './table.mjs';

const models = join(root, 'public', 'models');
/** @type {{ name: string, pelt?: string }[]} */
const listed = JSON.parse(readFileSync(join(models, 'models.json'), 'utf8'));
const PELTS = listed.flatMap(({ name, pelt }) => (pelt && name === `pelt-${pelt}` ? [pelt] : []));
const BODIES = ['sphere', 'bunny'];
const VIEWPORT = { width: 360, height: 300 };
/** Any colour that no fur has. */
const OTHER = '0000ff,0000ff';

/** @param {string} text of an option; @param {string[]} known; @param {string} name */
function listOf(text, known, name) {
	const names = text.split(',');
	for (const one of names)
		if (!known.includes(one)) throw new Failure(`--${name}: got ${one}, expected some of ${known.join(', ')}`);
	return names;
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
				const swatch =
					body === 'sphere'
						? await toSwatch(page, server.url, join(models, `pelt-${preset}`), preset, folder)
						: undefined;
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
