/** Everybody can use every page: no serious finding of axe in either scheme and either language, and nothing moves unasked. */

import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect, site, state, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';
import { restyle } from '../robust.ts';

/** What each page shows here, as little as it can, and the window's size: width and height. */
const PAGES: [file: string, query: string, width: number, height: number][] = [
	// With its panel, and with a notice of what the address says wrong.
	['index.html', '?model=sphere&shells=4&still=1&light=north', 900, 500],
	// So high that all figures are in it, and built.
	['learn.html', '?still=1', 700, 18_000],
	['bench.html', '?methods=magic', 900, 500],
	['embed.html', '?', 700, 900],
	['404.html', '?', 900, 500],
	// With tables and code that scroll.
	['docs/options.html', '?', 390, 800],
	['example.html', '?', 160, 120],
];
const SCHEMES = ['light', 'dark'] as const;

async function load(page: Page, address: string): Promise<void> {
	await page.goto(site + address);
	// Pages without a word of their own have nothing to load.
	await expect.poll(() => state(page)).not.toBe('loading');
	expect(await state(page)).not.toBe('failed');
}

/** One line for each serious or critical finding and the element that it is about. */
async function findings(page: Page): Promise<string[]> {
	const { violations } = await new AxeBuilder({ page }).analyze();
	return violations
		.filter(({ impact }) => impact === 'serious' || impact === 'critical')
		.flatMap(({ id, nodes }) =>
			nodes.map(({ target, failureSummary }) => `${id}: ${target.join(' ')}: ${failureSummary?.replace(/\s+/g, ' ')}`),
		);
}

for (const [file, query, width, height] of PAGES) {
	for (const language of ['en', 'zh']) {
		// The lesson takes half a minute, and its elements are the same in each language.
		const tag = file === 'learn.html' && language !== 'en' ? '@long' : [];
		test(`axe finds nothing serious on ${file} in ${language}, in either scheme`, { tag }, async ({ page }) => {
			// It looks at elements; no pixel of a picture is one.
			await drawNothing(page);
			await page.setViewportSize({ width, height });
			await load(page, `${file}${query}&lang=${language}`);
			// All of the lesson at once is more than anybody sees.
			const built = expect(page.locator('figure[data-figure]:not([data-state=ready])'));
			await built.toHaveCount(0, { timeout: 90_000 });
			for (const colorScheme of SCHEMES) {
				await page.emulateMedia({ colorScheme });
				expect(await findings(page), colorScheme).toEqual([]);
			}
		});
	}
}

test('where reduced motion is asked for, nothing moves by itself', async ({ page }) => {
	await page.emulateMedia({ reducedMotion: 'reduce' });
	const rests = async (what: string) => {
		let before = await page.screenshot();
		// What is drawn as soon as it comes into view has a moment for it.
		await expect(async () => {
			const now = await page.screenshot();
			const same = now.equals(before);
			before = now;
			expect(same, what).toBe(true);
		}).toPass({ intervals: [500] });
		await page.waitForTimeout(1000);
		expect((await page.screenshot()).equals(before), what).toBe(true);
	};
	await load(page, '?model=sphere&shells=4');
	// Numbers of the last frame may come late; they are no motion.
	await restyle(page, '#overlay { visibility: hidden }');
	await rests('the demo');
	await load(page, 'learn.html');
	for (const figure of await page.locator('figure:has(canvas)').all()) {
		await figure.scrollIntoViewIfNeeded();
		await rests((await figure.getAttribute('data-figure')) ?? 'a figure');
	}
});
