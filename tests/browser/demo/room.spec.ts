/** The model's room: no control covers the model, whatever the window; tools say what they are to everyone. */

import type { Page } from '@playwright/test';
import { expect, open, settled, site, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';

const QUERY = '?model=sphere&shells=4&still=1';

interface Box {
	x: number;
	y: number;
	width: number;
	height: number;
}

/** Where the model is, once the picture rests. */
async function modelBox(page: Page): Promise<Box> {
	let before = '';
	await expect(async () => {
		const now = (await page.locator('#picture').getAttribute('data-box')) ?? '';
		const same = now !== '' && now === before;
		before = now;
		expect(same).toBe(true);
	}).toPass({ intervals: [120] });
	const [x = 0, y = 0, width = 0, height = 0] = before.split(',').map(Number);
	return { x, y, width, height };
}

/** Pixels of the first box that the second covers. */
function overlap(a: Box, b: Box): number {
	const wide = Math.min(a.x + a.width, b.x + b.width) - Math.max(a.x, b.x);
	const high = Math.min(a.y + a.height, b.y + b.height) - Math.max(a.y, b.y);
	return wide > 0 && high > 0 ? wide * high : 0;
}

/** Share of the model's box that each control covers, those that cover none left out. */
async function covers(page: Page): Promise<[name: string, share: number][]> {
	const box = await modelBox(page);
	const { width, height } = page.viewportSize() ?? { width: 0, height: 0 };
	expect(overlap(box, { x: 0, y: 0, width, height }), 'the model is in the window').toBe(box.width * box.height);
	// Not lost in it, either: half as large as the smaller side that a sheet may leave.
	expect(Math.max(box.width, box.height)).toBeGreaterThan(0.25 * Math.min(width, height));
	const found: [string, number][] = [];
	for (const name of ['#top', '#panel .lil-root', '#dock', '#overlay p']) {
		const control = page.locator(name);
		const area = (await control.isVisible()) ? await control.boundingBox() : null;
		const covered = area ? overlap(box, area) / (box.width * box.height) : 0;
		if (covered > 0) found.push([name, covered]);
	}
	return found;
}

test.beforeEach(({ page }) => drawNothing(page));

test('no control covers the model at 900 to 1440 px, with the panel open and closed', async ({ page }) => {
	await page.setViewportSize({ width: 900, height: 700 });
	await open(page, QUERY);
	const panel = page.locator('#panel .lil-root');
	const title = page.getByRole('button', { name: 'Fur', exact: true });
	for (const [width, height] of [
		[900, 700],
		[1000, 700],
		[1100, 700],
		[1440, 900],
	] as const) {
		await page.setViewportSize({ width, height });
		await expect(panel).not.toHaveClass(/lil-closed/);
		expect(await covers(page), `${width} px, open`).toEqual([]);
		const { x } = await modelBox(page);
		await title.click();
		await expect(panel).toHaveClass(/lil-closed/);
		await expect.poll(async () => (await modelBox(page)).x).toBeGreaterThan(x + 20);
		expect(await covers(page), `${width} px, closed`).toEqual([]);
		await title.click();
		await expect.poll(async () => (await modelBox(page)).x).toBeLessThan(x + 1);
	}
});

test('all links of the header are in view on the narrowest phones', async ({ browser }) => {
	for (const width of [320, 360, 390]) {
		const context = await browser.newContext({ viewport: { width, height: 640 }, hasTouch: true, isMobile: true });
		const page = await context.newPage();
		for (const address of ['?model=sphere&shells=1&fins=0&still=1', 'bench.html']) {
			await page.goto(`${site}${address}`);
			await expect(page.locator('.site .language')).toBeInViewport({ ratio: 1 });
			const boxes = await page.locator('.site a').evaluateAll((all) => all.map((one) => one.getBoundingClientRect()));
			for (const [i, box] of boxes.entries()) {
				expect(box.left, `${address}, ${width} px`).toBeGreaterThanOrEqual(boxes[i - 1]?.right ?? 0);
				expect(box.height).toBeGreaterThanOrEqual(40);
			}
			expect(boxes.at(-1)?.right).toBeLessThan(width - 8);
		}
		await context.close();
	}
});

test.describe('on a phone', () => {
	test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });

	test('the panel is a sheet over at most half, and the model stays in view', async ({ page }) => {
		await open(page, QUERY);
		expect(await covers(page)).toEqual([]);
		const before = await modelBox(page);
		await page.getByRole('button', { name: 'Fur', exact: true }).tap();
		await expect.poll(async () => (await modelBox(page)).y).toBeLessThan(before.y);
		const sheet = await page.locator('#panel .lil-root').boundingBox();
		expect(sheet).toMatchObject({ x: 0, y: 422, width: 390, height: 422 });
		expect(await covers(page)).toEqual([]);
		const title = page.getByRole('button', { name: 'Body', exact: true });
		await expect(title).toBeInViewport();
	});

	test('every tool has its word, and its hint once it is chosen', async ({ page }) => {
		await open(page, QUERY);
		const tools = [...(await page.locator('#tools label:visible').all()), page.locator('#orbit')];
		expect(tools).toHaveLength(6);
		const hint = page.locator('#hint');
		let before = '';
		for (const tool of tools) {
			const word = tool.locator('.short');
			await expect(word).toBeVisible();
			expect((await word.boundingBox())?.width).toBeGreaterThan(15);
			const { width = 0, height = 0 } = (await tool.boundingBox()) ?? {};
			expect(Math.min(width, height)).toBeGreaterThanOrEqual(44);
			await tool.tap();
			await expect(word).toHaveCSS('font-weight', '600');
			await expect(hint).not.toHaveText(before);
			before = (await hint.textContent()) ?? '';
		}
	});
});

test('every tool shows its whole name to mouse and keyboard', async ({ page }) => {
	await page.setViewportSize({ width: 900, height: 700 });
	await open(page, QUERY);
	const tips = page.locator('#dock .tip:visible');
	const names = ['Move the light', 'Stroke the fur', 'Rain', 'Mud', 'Grab and shake', 'Turn camera'];
	await expect(tips).toHaveText(names);
	const shown = () =>
		tips.evaluateAll((all) => all.filter((tip) => getComputedStyle(tip).opacity === '1').map((tip) => tip.textContent));
	const cells = [...(await page.locator('#tools label:visible').all()), page.locator('#orbit')];
	for (const [i, cell] of cells.entries()) {
		await cell.hover();
		await expect.poll(shown, { intervals: [50] }).toEqual([names[i]]);
	}
	await page.mouse.move(450, 650);
	await expect.poll(shown, { intervals: [50] }).toEqual([]);
	await page.getByRole('radio', { name: 'Move the light' }).focus();
	for (const name of names.slice(1, -1)) {
		await page.keyboard.press('ArrowDown');
		await expect.poll(shown, { intervals: [50] }).toEqual([name]);
	}
	await page.keyboard.press('Tab');
	await expect.poll(shown, { intervals: [50] }).toEqual(['Turn camera']);
	await expect(page.getByRole('button', { name: 'Turn camera' })).toBeFocused();
});

test('the model glides to its place with the line of the split, and the camera of the address stays', async ({
	page,
}) => {
	await page.setViewportSize({ width: 1000, height: 700 });
	await open(page, '?model=sphere&shells=4&light=0,1,1&camera=20,10,1.1&split=unlit,0.5');
	const line = page.locator('#split');
	const middle = async () => Number.parseFloat(await line.evaluate((element) => element.style.left));
	const first = await middle();
	expect(first).toBeLessThan(45);
	const places = await line.evaluate(async (element) => {
		document.querySelector<HTMLElement>('#panel .lil-title')?.click();
		const seen = new Set<number>();
		// A frame, however slow, moves it a part of the way.
		const end = performance.now() + 20_000;
		while (seen.size <= 5 && performance.now() < end) {
			await new Promise(requestAnimationFrame);
			seen.add(Number.parseFloat(element.style.left));
		}
		return [...seen];
	});
	expect(places.length).toBeGreaterThan(5);
	expect(places).toEqual([...places].sort((a, b) => a - b));
	await expect.poll(middle).toBeGreaterThan(first + 5);
	expect(await settled(page, 'camera')).toBe('20,10,1.1');
	expect(await settled(page, 'split')).toBe('unlit,0.5');
});
