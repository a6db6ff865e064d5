import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import { encode } from 'fast-png';
import { patched, renamed, triangle, zipped } from '../../web/demo/open/zips.ts';
import { difference, expect, open, type Picture, picture, state, test } from '../harness.ts';
import { dropFiles, type Files } from './dropFiles.ts';

test.use({ viewport: { width: 160, height: 120 } });

const folder = fileURLToPath(new URL('../../../public/models/torus-512/', import.meta.url));
const baked: Files = Object.fromEntries(
	readdirSync(folder).map((name) => [name, new Uint8Array(readFileSync(`${folder}${name}`))]),
);
const without = (lost: string): Files => Object.fromEntries(Object.entries(baked).filter(([name]) => name !== lost));
const text = (words: string) => new TextEncoder().encode(words);

const good = zipped(baked);
const asset = new TextDecoder().decode(baked['model.gltf']);
const newer = {
	...baked,
	'model.gltf': text(asset.replace(/("FUR_ptm_shells": \{\s*"version": )"\d\.\d"/, '$1"9.0"')),
};
const small = encode({ width: 8, height: 8, channels: 4, depth: 8, data: new Uint8Array(256) });

/** Of a model whose skin has one picture. */
const pictured = {
	meshes: [{ primitives: [{ attributes: { POSITION: 0 }, material: 0 }] }],
	materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }],
	textures: [{ source: 0 }],
};

/** Holds a folder above the page as a file manager does, and lets go of it or not; no script can make such a thing. */
async function hold(page: Page, path: string, types: ('dragEnter' | 'dragOver' | 'drop')[], at = 90): Promise<void> {
	const browser = await page.context().newCDPSession(page);
	const data = { items: [], files: [path], dragOperationsMask: 1 };
	for (const type of types) await browser.send('Input.dispatchDragEvent', { type, x: at, y: at, data });
	await browser.detach();
}

/** What the page says of the model; nothing of those before. */
const said = (page: Page) => page.locator('.notice p');

/** The picture alone. */
async function bare(page: Page): Promise<Picture> {
	await expect.poll(() => state(page)).toBe('ready');
	const show = (ui: boolean) =>
		page.evaluate((ui) => {
			document.body.classList.toggle('bare', !ui);
			document.getElementById('notices')?.classList.toggle('ui', !ui);
		}, ui);
	await show(false);
	const taken = await picture(page);
	await show(true);
	return taken;
}

/** Files and folders are chosen by the keyboard, and named in the panel while they are on show. */
async function choose(page: Page): Promise<void> {
	// Small windows have it closed.
	await page.getByRole('button', { name: 'Fur', exact: true, expanded: false }).press('Enter');
	const model = page.getByRole('combobox', { name: 'Model' });
	const button = page.getByRole('button', { name: 'Open …', exact: true });
	const [chooser] = await Promise.all([page.waitForEvent('filechooser'), button.press('Enter')]);
	await chooser.setFiles({ name: 'cat.glb', mimeType: '', buffer: Buffer.from(triangle()) });
	await expect(model).toHaveValue('cat');
	// Dialogs for folders can't be watched; the field that opens them can.
	const field = page.locator('input[webkitdirectory]');
	await field.evaluate((input: HTMLInputElement) =>
		input.addEventListener('click', (event) => {
			event.preventDefault();
			input.title = 'asked';
		}),
	);
	await page.getByRole('button', { name: 'Open folder …', exact: true }).press('Enter');
	await expect(field).toHaveAttribute('title', 'asked');
	await field.setInputFiles(folder);
	await expect(model).toHaveValue('torus-512');
	await expect(model.locator('option')).not.toContainText(['cat']);
	await model.selectOption('Sphere');
	await expect.poll(() => new URL(page.url()).searchParams.get('model')).toBe('sphere');
	expect(await model.locator('option').allTextContents()).not.toContain('torus-512');
}

interface Addresses {
	made: number;
	revoked: number;
}

test('what is dropped or chosen is shown, or a sentence says why not and the model before stays', async ({
	page,
	watch,
}) => {
	await page.addInitScript(() => {
		const counts: Addresses = { made: 0, revoked: 0 };
		const { createObjectURL, revokeObjectURL } = URL;
		Object.assign(window, { counts });
		URL.createObjectURL = (object) => {
			counts.made++;
			return createObjectURL(object);
		};
		URL.revokeObjectURL = (address) => {
			counts.revoked++;
			revokeObjectURL(address);
		};
	});
	const counts = () => page.evaluate(() => (window as unknown as { counts: Addresses }).counts);
	await open(page, '?model=torus-512&light=-.8,.5,.3&camera=20,38,1&shells=4&still=1');
	const torus = await bare(page);

	const sign = page.getByText('Drop a baked folder, its zip, a .glb or a .ptm');
	await hold(page, folder, ['dragEnter', 'dragOver']);
	await expect(sign).toBeVisible();
	await hold(page, folder, ['dragOver'], -9);
	await expect(sign).toBeHidden();

	// The first drop fetches what opens them; after it nothing is fetched any more.
	let fetched: number | undefined;
	const broken: [what: Files, sentence: string][] = [
		[{ 'cat.txt': text('cat') }, 'it is text (.txt); expected a baked folder, its zip, a .glb or a .ptm'],
		[
			{ 'cat.obj': text('v 0 0 0') },
			'it is a mesh without fur (.obj). The baker reads it:\nnpm run bake -- cat.obj -o public/models/cat',
		],
		[{ 'empty.zip': zipped({}) }, 'the zip is empty; expected a baked folder with model.gltf'],
		[{ 'words.zip': zipped({ 'words.txt': 'cat' }) }, 'there is no model.gltf in it, only words.txt'],
		[{ 'none.zip': text('solid cat') }, 'it is not a zip file, despite its name'],
		[{ 'half.zip': good.slice(0, good.length / 2) }, 'the end is missing: it was not copied or downloaded completely'],
		[
			{ 'bare.zip': zipped(without('model.gltf'), 0) },
			'model.gltf is missing: the other files of a baked folder are there',
		],
		[{ 'hole.zip': zipped(without('plane1.png'), 0) }, 'plane1.png: it is not in the zip'],
		[{ 'small.zip': zipped({ ...baked, 'plane1.png': small }, 0) }, 'plane1.png: got 8 × 8 pixels, expected 64 × 1024'],
		[{ 'up.zip': zipped({ '../../x': 'x', ...baked }, 0) }, '“../../x” leads out of the zip; such a zip is not opened'],
		[{ 'bomb.zip': patched(good, 'plane0.png', { size: 400e6 }) }, 'its files are 400.4 MB; at most 300 MB are opened'],
		[
			{ 'trap.zip': patched(good, 'plane0.png', { size: 1000 }) },
			'plane0.png: it unpacks to more than the 1000 bytes that the zip states; such a zip is not opened',
		],
		[
			{ 'secret.zip': patched(good, 'model.bin', { flags: 1 }) },
			'model.bin: it is encrypted; expected a zip without a password',
		],
		[{ 'twice.zip': renamed(good, 'fin1.png', 'fin0.png') }, 'fin0.png: it is in the zip twice'],
		[
			{ 'far.gltf': text('{"asset": {"version": "2.0"}, "buffers": [{"uri": "https://example.org/cat.bin"}]}') },
			'https://example.org/cat.bin: it is on another site; nothing is fetched for a dropped model',
		],
		[
			{ 'packed.glb': triangle({ extensionsUsed: ['KHR_draco_mesh_compression'] }) },
			'its mesh is packed by Draco, which this page does not unpack. The baker does:\nnpm run bake -- packed.glb -o public/models/packed',
		],
		[
			{ 'torn.glb': triangle({ ...pictured, images: [{ bufferView: 0, mimeType: 'image/png', name: 'coat' }] }) },
			'coat: it is not a picture that this browser can read',
		],
		[
			{ 'torn.gltf': triangle({ ...pictured, images: [{ uri: 'data:image/png;base64,AAAA' }] }) },
			'image 0: it is not a picture that this browser can read',
		],
	];
	for (const [what, sentence] of broken) {
		const [name = ''] = Object.keys(what);
		await dropFiles(page, what);
		await expect(said(page)).toContainText(sentence);
		await expect(said(page)).toContainText(`${name.replace(/\..*$/, '')}`);
		expect(difference(torus, await bare(page)), name).toBe(0);
		fetched ??= watch.requests.length;
	}
	// A zip too large is never read: it has no bytes of its own.
	await page.evaluate(() => {
		let zeros = new Blob([new Uint8Array(2e5)]);
		for (let i = 0; i < 3; i++) zeros = new Blob(Array(10).fill(zeros));
		const transfer = new DataTransfer();
		transfer.items.add(new File([zeros], 'huge.zip'));
		document.body.dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: transfer }));
	});
	await expect(said(page)).toContainText('the zip is 200 MB; at most 100 MB are opened');
	expect(difference(torus, await bare(page))).toBe(0);
	expect(new URL(page.url()).searchParams.get('model')).toBe('torus-512');

	// Good ones, each after another model.
	await dropFiles(page, { 'My cat.glb': triangle() });
	await expect(said(page)).toContainText('npm run bake -- "My cat.glb" -o public/models/My-cat');
	const cat = await bare(page);
	expect(difference(torus, cat)).toBeGreaterThan(2);
	await expect.poll(() => new URL(page.url()).search).toBe('?light=-0.808,0.505,0.303&camera=20,38,1&shells=4&still=1');

	await dropFiles(page, { 'torus.zip': good });
	await expect.poll(async () => difference(torus, await bare(page))).toBeLessThan(0.01);
	await dropFiles(page, { 'new.zip': zipped(newer, 0) });
	await expect(said(page)).toContainText('its fur is of version 9.0, newer than the 2.3 that this page knows');
	expect(difference(torus, await bare(page))).toBeGreaterThan(1);
	await hold(page, folder, ['dragEnter', 'dragOver', 'drop']);
	await expect.poll(async () => difference(torus, await bare(page))).toBeLessThan(0.01);
	await dropFiles(page, { 'cat.glb': triangle() });
	await expect(said(page)).toContainText('npm run bake -- cat.glb');
	await dropFiles(page, baked);
	await expect.poll(async () => difference(torus, await bare(page))).toBeLessThan(0.01);

	const { made, revoked } = await counts();
	expect(made).toBeGreaterThan(4 * 7);
	expect(revoked).toBe(made);
	// A new address has the browser ask for the page's icon again.
	expect(watch.requests.slice(fetched).filter((url) => !/^blob:|\/icon\.svg$/.test(url))).toEqual([]);

	await choose(page);
});
