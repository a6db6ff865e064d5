/** The example of the docs for @react-three/fiber, taken from there, built and drawn; and the element among React's own. */

import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { barePlugin } from '../../../web/tools/site/plugins.mjs';
import { difference, expect, picture, test } from '../harness.ts';
import { type Host, serveFolder } from '../host.ts';

const root = fileURLToPath(new URL('../../..', import.meta.url));
let folder = '';
let host: Host;

test.use({ viewport: { width: 240, height: 180 } });

/** The element in a tree of React's; its events and properties are React's to set. */
const ELEMENT = `
import { createRoot } from 'react-dom/client';
const ready = ({ target }) => { target.dataset.heard = target.state; };
createRoot(document.getElementById('root')).render(
	<fur-view src="models/torus-512/model.gltf" light="-0.9,0.3,0.2" camera={[20, 38, 0.9]} controls onready={ready} />,
);`;

test.beforeAll(async () => {
	// Inside the repository, whose packages it finds.
	const cache = join(root, 'node_modules', '.cache', 'furbake');
	mkdirSync(cache, { recursive: true });
	folder = mkdtempSync(join(cache, 'react-'));
	const guide = readFileSync(join(root, 'web', 'docs', 'react.md'), 'utf8');
	const files = [...guide.matchAll(/<!-- file: (\S+) -->\s*```jsx\n([\s\S]*?)```/g)];
	expect(files.map(([, name]) => name)).toEqual(['Fur.jsx', 'main.jsx']);
	for (const [, name, text] of files) writeFileSync(join(folder, `${name}`), `${text}`);
	writeFileSync(join(folder, 'element.jsx'), ELEMENT);
	const page = (scripts: string) =>
		`<!doctype html><html lang="en"><head><meta charset="utf-8" /><title>React</title><link rel="icon" href="icon.svg" />
		<link rel="stylesheet" href="./page.css" />${scripts}</head><body><div id="root"></div></body></html>`;
	writeFileSync(
		join(folder, 'page.css'),
		'html, body, #root, #picture, fur-view { margin: 0; width: 100%; height: 100% }',
	);
	writeFileSync(join(folder, 'index.html'), page('<script type="module" src="./main.jsx"></script>'));
	writeFileSync(
		join(folder, 'element.html'),
		page('<script type="module" src="./view.js"></script><script type="module" src="./element.jsx"></script>'),
	);
	writeFileSync(join(folder, 'view.js'), `import ${JSON.stringify(join(root, 'web', 'view', 'index.ts'))};`);
	await build({
		root: folder,
		base: './',
		configFile: false,
		logLevel: 'error',
		publicDir: join(root, 'public'),
		plugins: [barePlugin()],
		oxc: { jsx: { runtime: 'automatic' } },
		resolve: { alias: { furbake: join(root, 'web', 'fur', 'index.ts') }, dedupe: ['three', 'react'] },
		build: {
			modulePreload: { polyfill: false },
			chunkSizeWarningLimit: 1500,
			rolldownOptions: { input: ['index.html', 'element.html'].map((name) => join(folder, name)) },
		},
	});
	host = await serveFolder(join(folder, 'dist'), '/');
});

test.afterAll(() => {
	host?.close();
	rmSync(folder, { recursive: true, force: true });
});

test('the component of the docs draws fur under the pointer as lamp', async ({ page, watch }) => {
	const shown = async () => {
		await page.goto(host.address);
		await expect(page.locator('#picture')).toHaveAttribute('data-state', 'ready');
		await page.mouse.move(20, 40);
		let last = await picture(page);
		await expect(async () => {
			const now = await picture(page);
			const moved = difference(last, now);
			last = now;
			expect(moved).toBe(0);
			const ground = now.brightness[0] ?? 0;
			expect(
				now.brightness.filter((value) => Math.abs(value - ground) > 8).length / now.brightness.length,
			).toBeGreaterThan(0.1);
		}).toPass({ intervals: [400] });
		return last;
	};
	const furry = await shown();
	await page.mouse.move(220, 40);
	await expect.poll(async () => difference(furry, await picture(page))).toBeGreaterThan(2);

	await page.route('**/model.gltf', async (route) => {
		const { extensions: _, ...plain } = await (await route.fetch()).json();
		await route.fulfill({ json: plain });
	});
	expect(difference(furry, await shown()), 'from the skin alone').toBeGreaterThan(5);
	// Fiber's own clock is one that this three calls out of date.
	expect(watch.complaints.splice(0).filter((text) => !/THREE\.Clock.*deprecated/.test(text))).toEqual([]);
});

test('React sets the attributes of the tag and hears its events', async ({ page }) => {
	await page.goto(`${host.address}element.html`);
	const view = page.locator('fur-view');
	await expect(view).toHaveAttribute('data-heard', 'ready');
	await expect(view).toHaveAttribute('light', '-0.9,0.3,0.2');
	await expect(view).toHaveAttribute('camera', '20,38,0.9');
	await expect(view.getByRole('button')).toHaveCount(2);
});
