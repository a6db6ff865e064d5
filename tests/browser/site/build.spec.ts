import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { expect, open, state, test } from '../harness.ts';
import { type Host, serveFolder, weightOf } from '../host.ts';
import { drawNothing } from '../inPage/gpu.ts';
import { licencesIn } from './licences.ts';

/** Bytes over the wire of the demo with its default model, alive: 0.75 MB, and what a browser may ask for sooner or later (its icon). */
const [UNTIL_FUR, COARSE, WHOLE] = [0.75e6, 0.78e6, 2.2e6];

let dist = '';
let host: Host;

test.use({ viewport: { width: 240, height: 180 } });

test.beforeAll(async () => {
	dist = mkdtempSync(join(tmpdir(), 'furbake-dist-'));
	await build({
		configFile: fileURLToPath(new URL('../../../web/vite.config.ts', import.meta.url)),
		logLevel: 'error',
		build: { outDir: dist },
	});
	host = await serveFolder(dist, '/some/sub/folder/');
});

test.afterAll(() => {
	host?.close();
	rmSync(dist, { recursive: true, force: true });
});

// What the policy stops is a complaint, and any complaint fails its test.
test.beforeEach(async ({ page }) => {
	await page.addInitScript(() => {
		addEventListener('securitypolicyviolation', ({ effectiveDirective, blockedURI, sourceFile, lineNumber }) => {
			console.warn(`policy: ${effectiveDirective} stops ${blockedURI} in ${sourceFile}:${lineNumber}`);
		});
	});
});

test.afterEach(({ watch }) => {
	const elsewhere = watch.requests.filter((url) => !/^(data|blob):/.test(url) && !url.startsWith(host.address));
	expect(elsewhere, 'requests that leave the folder').toEqual([]);
});

test('the built demo, and what it weighs', async ({ page, watch }, { annotations }) => {
	await drawNothing(page);
	host.sent.length = 0;
	await open(page, '?still=1&planes=128', host.address);
	expect(await state(page)).toBe('ready');
	// The mark of the first furry frame.
	const fur = await page.evaluate(() => {
		const mark = performance.getEntriesByName('furbake:fur')[0];
		return performance.timeOrigin + (mark?.startTime ?? performance.now());
	});
	await page.waitForLoadState('networkidle');
	const weights = {
		'until the first furry frame': weightOf(host.sent.filter(({ ended }) => ended <= fur)),
		'without finer planes': weightOf(host.sent.filter(({ path }) => !path.startsWith('/models/fine-'))),
		whole: weightOf(host.sent),
	};
	const written = Object.entries(weights).map(([type, bytes]) => ({
		type,
		description: `${(bytes / 1e6).toFixed(3)} MB`,
	}));
	process.stdout.write(
		`     the demo: ${written.map(({ type, description }) => `${description} ${type}`).join(', ')}\n`,
	);
	annotations.push(...written);
	for (const { path, bytes } of host.sent) annotations.push({ type: path, description: `${bytes} B` });
	expect(weights['until the first furry frame'], 'until the first furry frame').toBeLessThan(UNTIL_FUR);
	expect(weights['without finer planes'], 'without finer planes').toBeLessThan(COARSE);
	expect(weights.whole, 'the whole page').toBeLessThan(WHOLE);
	expect(weights.whole).toBeGreaterThan(1.7e6);

	// The picture is dark in either scheme: words over it are light in the light one, too.
	await page.emulateMedia({ colorScheme: 'light' });
	const [red = 0, green = 0, blue = 0] = await page.locator('#hint').evaluate((hint) => {
		const context = new OffscreenCanvas(1, 1).getContext('2d') as OffscreenCanvasRenderingContext2D;
		context.fillStyle = getComputedStyle(hint).color;
		context.fillRect(0, 0, 1, 1);
		return [...context.getImageData(0, 0, 1, 1).data];
	});
	expect(Math.min(red, green, blue)).toBeGreaterThan(160);

	// Timers of five microseconds, and places of light only where they are asked for.
	expect(await page.evaluate(() => crossOriginIsolated)).toBe(true);
	const exr = () => watch.requests.filter((url) => /\.exr/.test(url)).map((url) => url.replace(/.*\/|-[^-]*$/g, ''));
	expect(exr()).toEqual([]);
	await open(page, '?still=1&env=sunset&model=sphere&shells=4', host.address);
	expect(await state(page)).toBe('ready');
	expect(exr()).toEqual(['sunset.exr']);
});

test('the built lesson shows its figures', async ({ page }) => {
	await drawNothing(page);
	await page.goto(`${host.address}learn.html`);
	// In three dimensions, drawn flat, and of numbers; the others are made of the same.
	for (const name of ['shells', 'bits', 'numbers']) {
		const figure = page.locator(`figure[data-figure=${name}]`);
		await figure.scrollIntoViewIfNeeded();
		await expect(figure).toHaveAttribute('data-state', 'ready');
	}
	expect(await state(page)).toBe('ready');
});

test('the built bench measures', async ({ page }) => {
	await page.goto(`${host.address}bench.html?run=1&size=48x32&rounds=1&triangles=512&parts=results&methods=unlit,ptm`);
	await expect.poll(() => state(page)).toBe('done');
	await expect(page.locator('table').first()).toContainText('PTM');
});

test('the built docs are read without a script, on a phone, too', async ({ page }) => {
	await page.setViewportSize({ width: 360, height: 640 });
	await page.goto(`${host.address}docs/`);
	const list = page.getByRole('navigation', { name: 'Documentation' });
	await list.getByRole('link', { name: 'Presets' }).click();
	await expect(page.getByRole('heading', { level: 1 })).toHaveText('Presets');
	await expect(list.getByRole('link', { name: 'Presets' })).toHaveAttribute('aria-current', 'page');
	const picture = page.getByRole('img', { name: 'The bunny in the presets' });
	await expect.poll(() => picture.evaluate((image: HTMLImageElement) => image.naturalWidth)).toBeGreaterThan(0);
	expect(await page.evaluate(() => document.scripts.length)).toBe(0);
	expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(360);
});

test('every built page holds the policy, its own files and what a shared link shows', () => {
	const pages = readdirSync(dist).filter((name) => name.endsWith('.html'));
	expect(pages).toEqual(
		expect.arrayContaining(['404.html', 'bench.html', 'embed.html', 'example.html', 'index.html', 'learn.html']),
	);
	const policies = pages.map((name) => {
		const html = readFileSync(join(dist, name), 'utf8');
		const [head = ''] = html.split('</head>');
		expect(html, name).not.toMatch(/<style|\sstyle=|<script(?![^>]*\ssrc=)|\son\w+=/);
		const policy = head.indexOf('Content-Security-Policy');
		for (const [tag] of head.matchAll(/<(script|link)\b[^>]*>/g)) {
			expect(head.indexOf(tag), `${name}: ${tag}`).toBeGreaterThan(policy);
			const [, path] = /\s(?:src|href)="([^"]*)"/.exec(tag) ?? [];
			expect(existsSync(join(dist, `${path}`)), `${name}: ${path}`).toBe(true);
		}
		if (name !== '404.html') {
			expect(head, name).toMatch(/<meta property="og:title" content="furbake · [^"]+">/);
			expect(head, name).toContain('<meta property="og:image" content="./og.jpg">');
		}
		return /Content-Security-Policy" content="([^"]*)"/.exec(head)?.[1];
	});
	expect(new Set(policies).size).toBe(1);
	expect(policies[0]).toMatch(/^default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; /);
	expect(policies[0]).not.toMatch(/frame-ancestors|(?<!wasm-)unsafe-eval|script-src[^;]*unsafe-inline/);
});

test('the licence texts of all that is bundled are beside it', () => {
	const parts = licencesIn(readFileSync(join(dist, 'licenses.md'), 'utf8'));
	for (const name of ['@pmndrs/assets', 'fast-png', 'fflate', 'katex', 'lil-gui', 'stats-gl', 'three'])
		expect([...parts.keys()]).toContain(name);
	for (const [name, text] of parts) expect(text, name).toMatch(/permission|redistribution|waive/i);
	expect(parts.get('three/examples/jsm/loaders/EXRLoader.js')).toMatch(/Syoyo Fujita[\s\S]*Industrial Light & Magic/);
	// Those of lil-gui are a few pictures of its own.
	const fonts = readdirSync(join(dist, 'assets')).filter((name) => /\.(woff2?|ttf|otf)$/.test(name));
	expect(fonts.filter((name) => !/^(KaTeX_|font-)/.test(name))).toEqual([]);
	expect(parts.get('Fonts of katex')).toMatch(
		/Khan Academy[\s\S]*SIL OPEN FONT LICENSE Version 1\.1[\s\S]*OTHER DEALINGS/,
	);
});

test('an address that leads nowhere says so', async ({ page, watch }) => {
	await page.goto(`${host.address}nothing`);
	await expect(page.getByRole('heading')).toHaveText('No fur grows here');
	expect(await page.evaluate(() => getComputedStyle(document.querySelector('main') as Element).textAlign)).toBe(
		'center',
	);
	await expect(page.getByRole('link', { name: 'To the bunny' })).toHaveAttribute('href', './');
	// Chromium's own word about the status.
	for (const complaint of watch.complaints.splice(0)) expect(complaint).toContain('404');
});
