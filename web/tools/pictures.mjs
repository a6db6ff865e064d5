/**
 * `npm run pictures`: regenerates the project's pictures: `public/og.jpg` for shared links, `still.jpg`, the bunny under
 * three lights, `presets.jpg`, the bunny in every preset, `demo.jpg` and `learn.jpg`, the pages themselves, and `home.png`,
 * the icon on a phone's home screen. `npm run pictures -- --fox models/my-fox` makes
 * `fox.jpg` of README's fox, baked there, `-- --bear models/my-bear` `usd.jpg` of a groomed one; `npm run pictures -- --truth` traces the lesson's ring (minutes; `mitsuba`);
 * `npm run pictures -- --blender` furs, bakes and renders the monkey of the docs in Blender (minutes; installs `bpy`).
 */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { basename, join } from 'node:path';
import { browserArgs, ensureBrowser } from './browser.mjs';
import { ensureBlender, ensureNode, ensurePython, furbake, python } from './environment.mjs';
import { readOptions } from './measure/measure.mjs';
import { command, Failure, root, run, say } from './process.mjs';
import { serve } from './site/vite.mjs';

/** @import { Browser, Page } from '@playwright/test' */

const BUNNY = 'model=bunny&planes=128&camera=-20,10,0.9';
/** The fox running, looking about, and walking at sunset. */
const FOX = [
	'clip=Run&time=0.35&camera=62,8,0.8&light=0.1,0.7,0.7',
	'clip=Survey&time=1.2&camera=28,12,0.64&light=-0.4,0.7,0.5',
	'clip=Walk&time=0.3&camera=42,4,0.78&env=sunset&light=0.1,0.4,0.9',
];
/** The side from which a groomed bear is seen. */
const BEAR = 'camera=-35,10,0.8';
/** The monkey of the docs at rest, as Cycles has seen it, and in its clip. */
const MONKEY = ['camera=25,12,0.8&light=-0.5,0.75,0.35', 'clip=nod&time=0.5&camera=-20,8,0.8&light=0.6,0.6,0.5'];
/** Presets worn by the bunny, in the order of their page. */
const PRESETS = ['paper', 'bunny', 'fox', 'wolf', 'sheep', 'teddy', 'mole'];
/** Light from the left, from above, from behind. */
const LIGHTS = ['-0.9,0.45,0.2', '0.05,0.98,0.2', '0.75,0.45,-0.5'];
const WORDS = ['furbake', 'Fur that you relight by dragging,', 'baked from any mesh'];
/** Supersampling factor per side. */
const FINER = 2;
/** Milliseconds per picture, enough for software rendering. */
const PATIENCE = 300_000;

/**
 * @param {Browser} browser
 * @param {string} site
 * @param {string} what parameters of the address
 * @param {{ width: number, height: number }} viewport
 * @returns {Promise<string>} the picture as an address
 */
async function view(browser, site, what, viewport) {
	const page = await browser.newPage({ viewport, deviceScaleFactor: FINER });
	await page.goto(`${site}?${what}&still=1&ui=0`, { timeout: PATIENCE });
	await page.waitForFunction("document.documentElement.dataset.state !== 'loading'", null, { timeout: PATIENCE });
	const bytes = await page.screenshot({ timeout: PATIENCE });
	await page.close();
	return `data:image/png;base64,${bytes.toString('base64')}`;
}

/**
 * @param {Browser} browser
 * @param {string} body of a page
 * @param {{ width: number, height: number }} viewport
 * @param {string} name of the file in public/
 * @param {number} quality of the JPEG, 0 to 100
 */
async function keep(browser, body, viewport, name, quality) {
	const page = await browser.newPage({ viewport });
	await page.setContent(`<!doctype html><style>* { margin: 0; box-sizing: border-box }</style>${body}`);
	await page.evaluate('Promise.all([...document.images].map((image) => image.decode()))');
	await photograph(page, name, quality);
}

/** @param {Browser} browser; @param {string} site */
async function shared(browser, site) {
	const [width, height, wide, middle] = [1200, 630, 1720, 838]; // the bunny's middle beside the words
	const picture = await view(browser, site, `${BUNNY}&light=${LIGHTS[0]}`, { width: wide, height });
	const [name, ...lines] = WORDS;
	const body = `
		<style>
			body { overflow: hidden; color: #e9e4dc; font-family: "Liberation Sans", Helvetica, Arial, sans-serif }
			img { position: absolute; height: ${height}px; left: ${middle - wide / 2}px }
			div { position: absolute; left: 72px; top: 216px }
			h1 { font-size: 104px; line-height: 1; letter-spacing: -0.035em; color: #f3ead9 }
			p { margin-top: 26px; font-size: 31px; line-height: 1.36; color: #c3cbd2 }
		</style>
		<img src="${picture}" /><div><h1>${name}</h1><p>${lines.join('<br />')}</p></div>`;
	await keep(browser, body, { width, height }, 'og.jpg', 84);
}

/** @param {Browser} browser; @param {string} site */
async function still(browser, site) {
	await strip(
		browser,
		site,
		LIGHTS.map((light) => `${BUNNY}&light=${light}`),
		'still.jpg',
	);
}

/**
 * Square pictures in a row.
 *
 * @param {Browser} browser
 * @param {string} site
 * @param {string[]} views parameters of their addresses
 * @param {string} name of the file in public/
 * @param {string[]} [first] addresses of pictures before these
 */
async function strip(browser, site, views, name, first = []) {
	const side = 560;
	const pictures = [...first];
	for (const what of views) pictures.push(await view(browser, site, what, { width: side, height: side }));
	const images = pictures.map((picture) => `<img src="${picture}" width="${side}" height="${side}" />`);
	const body = `<div style="display: flex">${images.join('')}</div>`;
	await keep(browser, body, { width: side * pictures.length, height: side }, name, 84);
}

/** The bunny in every preset, and the tiger cub in two furs of its own. @param {Browser} browser; @param {string} site */
async function presets(browser, site) {
	const [side, columns] = [400, 4];
	const worn = PRESETS.map((preset) => [preset, `${BUNNY}&preset=${preset}&light=-0.6,0.65,0.45`]);
	const figures = [];
	for (const [name, what] of [...worn, ['two furs', 'model=tiger&camera=-20,8,1&light=-0.6,0.65,0.45']]) {
		const picture = await view(browser, site, what ?? '', { width: side, height: side });
		figures.push(`<figure><img src="${picture}" width="${side}" /><figcaption>${name}</figcaption></figure>`);
	}
	const body = `
		<style>
			body { display: grid; grid-template-columns: repeat(${columns}, ${side}px); font: 22px "Liberation Sans", Helvetica, Arial, sans-serif }
			figure { position: relative; height: ${side}px; color: #e9e4dc }
			figcaption { position: absolute; left: 20px; bottom: 16px }
		</style>${figures.join('')}`;
	const size = { width: side * columns, height: (side * figures.length) / columns };
	await keep(browser, body, size, 'presets.jpg', 84);
}

/** Two methods side by side. @param {Browser} browser; @param {string} site */
async function demo(browser, site) {
	const page = await browser.newPage({ viewport: { width: 1280, height: 760 }, colorScheme: 'dark', locale: 'en' });
	await page.goto(`${site}?model=bunny&planes=128&split=unlit,0.42&still=1&camera=-20,10,1&light=-0.72,0.6,0.3`);
	await page.waitForFunction("document.documentElement.dataset.state !== 'loading'", null, { timeout: PATIENCE });
	await photograph(page, 'demo.jpg');
}

/** The step of the slices. @param {Browser} browser; @param {string} site */
async function learn(browser, site) {
	const viewport = { width: 1280, height: 1060 };
	const page = await browser.newPage({ viewport, colorScheme: 'light', locale: 'en', reducedMotion: 'reduce' });
	await page.goto(`${site}learn.html#slices`);
	const ready = "document.querySelector('[data-figure=slices]')?.dataset.state === 'ready'";
	await page.waitForFunction(ready, null, { timeout: PATIENCE });
	// Wait for the figures above, which grow on screen.
	await page.waitForTimeout(3000);
	const top = "document.getElementById('slices').scrollIntoView({ behavior: 'instant' })";
	await page.evaluate(top);
	await photograph(page, 'learn.jpg');
}

/** The page's icon for the home screens of phones, which round its corners themselves. @param {Browser} browser */
async function home(browser) {
	const side = 180;
	const icon = readFileSync(join(root, 'public', 'icon.svg'), 'utf8').replace(/ rx="[^"]*"/, '');
	const page = await browser.newPage({ viewport: { width: side, height: side } });
	await page.setContent(`<!doctype html><style>body { margin: 0 } svg { display: block }</style>${icon}`);
	await photograph(page, 'home.png');
}

/**
 * @param {Page} page
 * @param {string} name of the file in public/
 * @param {number} quality of a JPEG, 0 to 100
 */
async function photograph(page, name, quality = 84) {
	const kind = name.endsWith('.png')
		? { type: /** @type {const} */ ('png') }
		: { type: /** @type {const} */ ('jpeg'), quality };
	await page.screenshot({ path: join(root, 'public', name), ...kind, timeout: PATIENCE });
	await page.close();
	say(`public/${name}`);
}

/** Path-traced pictures of the lesson's rivals. */
async function truth() {
	await ensurePython();
	const folder = join(root, 'web', 'learn', 'rivals');
	const file = join(folder, 'view.json');
	const { model } = JSON.parse(readFileSync(file, 'utf8'));
	const baked = join(root, 'public', 'models', model);
	const trace = 'import sys; from furbake.study.verify.lesson import write_pictures; write_pictures(*sys.argv[1:])';
	const code = await run(python, ['-c', trace, file, baked, folder]);
	if (code !== 0) throw new Failure('the pictures were not traced: the reason stands above');
}

/** The monkey of the docs by Cycles and on the page. @param {Browser} browser; @param {string} site */
async function blender(browser, site) {
	await ensurePython();
	const inside = await ensureBlender();
	const folder = mkdtempSync(join(root, 'public', 'models', 'blender-'));
	try {
		const code = await run(inside, [join(root, 'web', 'tools', 'site', 'monkey.py'), furbake, folder]);
		if (code !== 0) throw new Failure('the monkey was not baked: the reason stands above');
		const rendered = readFileSync(join(folder, 'monkey.png')).toString('base64');
		const model = `models/${basename(folder)}/monkey`;
		const shown = MONKEY.map((what) => `model=${model}&${what}`);
		await strip(browser, site, shown, 'blender.jpg', [`data:image/png;base64,${rendered}`]);
	} finally {
		rmSync(folder, { recursive: true, force: true });
	}
}

await command(async () => {
	const {
		fox,
		bear,
		truth: traced,
		blender: furred,
	} = readOptions({
		fox: { type: 'string' },
		bear: { type: 'string' },
		truth: { type: 'boolean' },
		blender: { type: 'boolean' },
	});
	await ensureNode();
	if (traced) {
		await truth();
		return;
	}
	const { chromium } = await import('@playwright/test');
	const server = await serve();
	const browser = await chromium.launch({ executablePath: await ensureBrowser(), args: browserArgs });
	try {
		if (furred) {
			await blender(browser, server.url);
			return;
		}
		if (bear) {
			const views = LIGHTS.map((light) => `model=${bear}&${BEAR}&light=${light}`);
			await strip(browser, server.url, views, 'usd.jpg');
			return;
		}
		if (fox) {
			await strip(
				browser,
				server.url,
				FOX.map((what) => `model=${fox}&${what}`),
				'fox.jpg',
			);
			return;
		}
		await shared(browser, server.url);
		await still(browser, server.url);
		await presets(browser, server.url);
		await demo(browser, server.url);
		await learn(browser, server.url);
		await home(browser);
	} finally {
		await browser.close();
		await server.close();
	}
});
