import { createReadStream, mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { expect, open, state, test } from './harness.ts';

const types: Record<string, string> = {
	'.html': 'text/html',
	'.js': 'text/javascript',
	'.css': 'text/css',
	'.json': 'application/json',
	'.png': 'image/png',
	'.jpg': 'image/jpeg',
};
const folder = '/some/folder/';

let dist = '';
let server: Server;

test.beforeAll(async () => {
	dist = mkdtempSync(join(tmpdir(), 'furbake-dist-'));
	await build({
		configFile: fileURLToPath(new URL('../../web/vite.config.ts', import.meta.url)),
		logLevel: 'error',
		build: { outDir: dist },
	});
	// As bare as a static host can be: files below one folder, and nothing else.
	server = createServer((request, response) => {
		const { pathname } = new URL(request.url ?? '/', 'http://localhost');
		const file = join(dist, normalize(pathname.slice(folder.length) || 'index.html'));
		if (!pathname.startsWith(folder) || !statSync(file, { throwIfNoEntry: false })?.isFile()) {
			response.writeHead(404).end();
			return;
		}
		response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
		createReadStream(file).pipe(response);
	});
	await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
});

test.afterAll(() => {
	server?.close();
	rmSync(dist, { recursive: true, force: true });
});

const originOf = () => `http://127.0.0.1:${(server.address() as AddressInfo).port}`;

test('the built bench measures from a sub-folder of a static host', async ({ page, watch }) => {
	const address = `${originOf()}${folder}bench.html`;
	await page.goto(`${address}?run=1&size=48x32&rounds=1&triangles=512&parts=results&methods=unlit,ptm`);
	await expect.poll(() => state(page), { timeout: 60_000 }).toBe('done');
	await expect(page.locator('table').first()).toContainText('PTM');
	expect(watch.requests.filter((url) => !url.startsWith('data:') && !url.startsWith(originOf() + folder))).toEqual([]);
});

test('the built site works from a sub-folder of a static host', async ({ page, watch }) => {
	const origin = originOf();
	await open(page, '?still=1', origin + folder);
	expect(await state(page)).toBe('ready');
	expect(watch.requests.filter((url) => url.includes('.exr'))).toEqual([]);
	const scripts = watch.requests.filter((url) => url.endsWith('.js')).map((url) => url.slice((origin + folder).length));
	expect(scripts.length).toBeGreaterThan(0);
	for (const script of scripts) expect(readFileSync(join(dist, script), 'utf8')).not.toContain('application/exr');

	await open(page, '?still=1&env=sunset', origin + folder);
	expect(await state(page)).toBe('ready');
	expect(watch.requests.filter((url) => url.includes('sunset.exr'))).toHaveLength(1);
	const elsewhere = watch.requests.filter((url) => !url.startsWith('data:') && !url.startsWith(origin + folder));
	expect(elsewhere).toEqual([]);
});
