/** `<fur-view>` as an element among others: its size, what is read out and focused, its slots, its print, its docs. */

import { readFileSync } from 'node:fs';
import type { Locator, Page } from '@playwright/test';
import { CLIPS, rigged } from '../../web/scene/clips/rigged.ts';
import { difference, expect, picture, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';
import { type Site, serveView, TORUS, until, withView } from './host.ts';

let site: Site;

test.use({ viewport: { width: 400, height: 300 } });

const GUIDE = readFileSync(new URL('../../../web/docs/fur-view.md', import.meta.url), 'utf8');

/** Style sheets of the tests: a policy may forbid style attributes. */
const CSS = `
#sizes { width: 360px } #sizes fur-view { width: auto; height: auto }
#sizes .row { display: flex } #sizes .column { display: flex; flex-direction: column; align-items: center }
#sizes .grid { display: grid; place-items: center } #sizes .inline { display: inline-block } #sizes .narrow { width: 200px }
#sizes fur-view.high { height: 90px } #sizes fur-view.wide { width: 120px } #sizes fur-view.most { max-width: 100% }
main { display: block } .large fur-view, fur-view.large { width: 240px; height: 180px }`;

test.beforeAll(async () => {
	site = await serveView();
	const model = new URL('../../../public/models/torus-512/', import.meta.url);
	const { extensions: _, materials: __, ...bare } = JSON.parse(readFileSync(new URL('model.gltf', model), 'utf8'));
	for (const { primitives } of bare.meshes) for (const primitive of primitives) delete primitive.material;
	site.write('bare/model.gltf', JSON.stringify(bare));
	site.write('bare/model.bin', readFileSync(new URL('model.bin', model)));
	for (const [name, bytes] of Object.entries(rigged(CLIPS))) site.write(`walker/${name}`, bytes);
	site.write('element.css', CSS);
	site.write(
		'poster.svg',
		'<svg xmlns="http://www.w3.org/2000/svg" width="300" height="100"><rect width="300" height="100" fill="#0a0"/></svg>',
	);
});

test.afterAll(() => site?.close());

const open = (page: Page, body: string) => site.open(page, `<link rel="stylesheet" href="element.css" />${body}`);

test('it is as wide as its place and 4 : 3, and 300 px wide where nothing else decides', async ({ page }) => {
	const sizes: [string, string, number, number][] = [
		['', '', 360, 270],
		['', 'high', 120, 90],
		['', 'wide', 120, 90],
		['', 'wide high', 120, 90],
		['row', '', 300, 225],
		['row', 'high', 120, 90],
		['row', 'wide', 120, 90],
		['column', '', 300, 225],
		['grid', '', 300, 225],
		['inline', '', 300, 225],
		['inline narrow', 'most', 200, 150],
		['row narrow', '', 200, 150],
		['row narrow', 'most', 200, 150],
		['grid narrow', 'most', 200, 150],
	];
	const places = sizes.map(
		([place, view]) => `<div class="${place}"><fur-view class="${view}"></fur-view>${place === 'row' ? 'a' : ''}</div>`,
	);
	await open(page, `<div id="sizes">${places.join('')}</div>`);
	await expect(page.locator('fur-view:defined')).toHaveCount(sizes.length);
	const shown = await page.locator('fur-view').evaluateAll((views) =>
		views.map((view) => {
			const { width, height } = view.getBoundingClientRect();
			return [Math.round(width), Math.round(height)];
		}),
	);
	expect(sizes.map(([place, view], i) => [place, view, ...(shown[i] ?? [])])).toEqual(sizes);
});

/** Whether an element reaches to all edges of another. */
async function fills(element: Locator, view: Locator): Promise<boolean> {
	const [a, b] = [await element.boundingBox(), await view.boundingBox()];
	return JSON.stringify(a) === JSON.stringify(b);
}

test('a view that fails keeps its poster and its alt, and takes no focus that it does not need', async ({
	page,
	watch,
}) => {
	const image = (slot: string) => `<img slot="${slot}" src="poster.svg" alt="" />`;
	const fail = (id: string, content = '') =>
		`<fur-view id="${id}" class="large" src="none" alt="A ring">${content}</fur-view>`;
	await open(
		page,
		`<fur-view id="empty" alt="Nothing"></fur-view>${fail('plain')}${fail('poster', image('poster'))}
		${fail('own', `${image('poster')}<p slot="fallback">Here is <a href="#a">a link</a></p>`)}
		${fail('image', image('fallback'))}<fur-view id="small" src="none"></fur-view><button>After</button>`,
	);
	for (const id of ['plain', 'poster', 'own', 'image', 'small']) {
		await page.locator(`#${id}`).scrollIntoViewIfNeeded();
		await until(page, 'failed', `#${id}`);
	}
	const view = (id: string) => page.locator(id);
	for (const id of ['#plain', '#poster'])
		await expect(view(id)).toMatchAriaSnapshot(`
			- img "A ring"
			- status:
			  - paragraph: This picture cannot be shown.
			  - paragraph: "model.gltf: there is no such file"
		`);
	for (const id of ['#own', '#image']) await expect(view(id).getByRole('img', { name: 'A ring' })).toBeAttached();
	// The picture stays, with the words over its lower edge; an author's own words have all of the place.
	const poster = view('#poster').locator('img');
	expect(await fills(poster, view('#poster'))).toBe(true);
	const words = await view('#poster').getByRole('status').boundingBox();
	const place = await view('#poster').boundingBox();
	expect(words && place && words.y - place.y).toBeGreaterThan(60);
	expect(words && place && words.y + words.height - place.y - place.height).toBeCloseTo(0, 1);
	await expect(view('#own').locator('img')).toBeHidden();
	expect(await fills(view('#image').locator('img'), view('#image'))).toBe(true);
	await expect(view('#image').locator('img')).toHaveCSS('object-fit', 'cover');
	// Light blue on slate, not dark blue.
	const link = await view('#own')
		.locator('a')
		.evaluate((a) => getComputedStyle(a).color);
	for (const part of link.match(/\d+/g)?.slice(0, 3) ?? []) expect(Number(part)).toBeGreaterThan(120);

	await page.evaluate(() => {
		document.body.tabIndex = -1;
		document.body.focus();
	});
	const focused = () => page.evaluate(() => document.activeElement?.id || `${document.activeElement?.textContent}`);
	const stops: string[] = [];
	while (stops.at(-1) !== 'After' && stops.length < 9) {
		await page.keyboard.press('Tab');
		stops.push(await focused());
	}
	expect(stops).toEqual(['a link', 'small', 'After']);
	await page.keyboard.press('Shift+Tab');
	await expect(view('#small').getByRole('status')).toHaveCSS('outline-style', 'solid');
	expect(watch.complaints.splice(0).join()).toContain('404');
});

test('the hint describes the canvas and is not read on its own; words follow the language of the page', async ({
	page,
}) => {
	await drawNothing(page);
	await open(page, `<fur-view class="large" ${TORUS} alt="A ring" controls></fur-view>`);
	await until(page, 'ready');
	await expect(page.locator('fur-view')).toMatchAriaSnapshot(`
		- application "A ring"
		- group "Light and view":
		  - button "Turn the view by dragging"
		  - button "Light and view as they were"
	`);
	expect(await page.locator('fur-view').ariaSnapshot()).not.toContain('Drag or press');
	await expect(page.getByRole('application')).toHaveAccessibleDescription(/^Drag or press the arrow keys/);
	const turn = page.getByRole('button').first();
	await page.evaluate(() => {
		document.documentElement.lang = 'zh-Hans';
	});
	await expect(turn).toHaveAccessibleName('拖动以转动视角');
	await withView(page, (view) => view.setAttribute('lang', 'en'));
	await expect(turn).toHaveAccessibleName('Turn the view by dragging');

	// Pressed and focused it has a ring of another colour than its own.
	await page.getByRole('application').focus();
	await page.keyboard.press('Tab');
	await page.keyboard.press('Enter');
	await expect(turn).toHaveAttribute('aria-pressed', 'true');
	const colours = await turn.evaluate((button) => {
		const { outlineStyle, outlineColor, backgroundColor } = getComputedStyle(button);
		return { outlineStyle, differs: outlineColor !== backgroundColor };
	});
	expect(colours).toEqual({ outlineStyle: 'solid', differs: true });

	// In colours of the system it is not like its neighbour either.
	await page.emulateMedia({ forcedColors: 'active' });
	const [pressed, other] = await page
		.getByRole('button')
		.evaluateAll((buttons) => buttons.map((button) => getComputedStyle(button).backgroundColor));
	expect(pressed).not.toBe(other);
	await page.emulateMedia({ forcedColors: null });

	await page.emulateMedia({ media: 'print' });
	await expect(turn).toBeHidden();
	await expect(page.getByRole('application')).toBeVisible();
});

test('a clip that is taken away leaves the picture that was before', async ({ page, watch }) => {
	await open(page, '<fur-view src="walker/model.gltf" light="0,0.5,0.8"></fur-view>');
	await until(page, 'ready');
	const view = page.locator('fur-view');
	await page.waitForTimeout(500);
	const before = await picture(view);
	for (const away of ['', 'None']) {
		await withView(page, (view) => view.setAttribute('clip', 'Leap'));
		await expect.poll(async () => difference(before, await picture(view))).toBeGreaterThan(1);
		if (away) await withView(page, (view) => view.setAttribute('clip', 'None'));
		else await withView(page, (view) => view.removeAttribute('clip'));
		await expect.poll(async () => difference(before, await picture(view))).toBeLessThan(0.1);
	}
	expect(watch.complaints.splice(0).join()).toContain('clip: got None, expected one of Walk, Leap, Go');
});

test('a model without fur is matt, lit from the sky too, and throws a shadow', async ({ page, watch }) => {
	// Without it the picture fades in.
	await page.emulateMedia({ reducedMotion: 'reduce' });
	await open(page, '<fur-view class="large" src="bare" camera="0,20,1" light="-0.8,0.5,0.1"></fur-view>');
	await until(page, 'ready');
	const { width, brightness } = await picture(page.locator('fur-view'));
	expect(brightness.filter((value) => value > 150).length / brightness.length).toBeGreaterThan(0.05);
	// As metal it is black where no lamp is mirrored.
	expect(brightness.filter((value) => value < 12).length).toBe(0);
	const ground = (x: number) => brightness[108 * width + x] ?? 0;
	expect(ground(25) - ground(width - 25)).toBeGreaterThan(8);
	expect(watch.complaints.splice(0).join()).toContain('fur-view: fur: got a model without any, expected a baked one');
});

test('the examples of the docs need just what they say to copy', async ({ page, watch }) => {
	await drawNothing(page);
	const examples = [
		...GUIDE.matchAll(/```html\n(?:<!-- (.*) -->\n)?(?:<script.*\n)?(<fur-view.*preset=.*|<fur-view.*controls.*)\n/g),
	];
	expect(examples).toHaveLength(3);
	for (const [, names = 'models/bunny', tag = ''] of examples) {
		watch.requests.splice(0);
		await open(page, tag);
		await until(page, 'ready');
		const asked = watch.requests
			.map((url) => new URL(url).pathname.slice(1))
			.filter((path) => path.startsWith('models/'));
		const copied = names.split(/, | and /);
		for (const path of asked)
			expect(
				copied.some((name) => path === name || path.startsWith(`${name}/`)),
				path,
			).toBe(true);
		for (const name of copied)
			expect(
				asked.some((path) => path.startsWith(name)),
				name,
			).toBe(true);
	}
});
