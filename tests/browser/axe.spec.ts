/** Everybody can use every page: no serious finding of axe in either scheme and either language, and nothing moves unasked. */

import { existsSync } from 'node:fs';
import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect, site, state, test } from './harness.ts';
import { repository } from './library.ts';

/** What each page shows here: as little as it can. */
const PAGES = {
	// With its panel, and with a notice of what the address says wrong.
	'index.html': '?model=sphere&shells=4&still=1&light=north',
	'learn.html': '?still=1',
	'bench.html': '?methods=magic',
	'404.html': '?',
	'example.html': '?',
};
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

for (const [file, query] of Object.entries(PAGES)) {
	test(`axe finds nothing serious on ${file}, in either language and scheme`, async ({ page }) => {
		test.skip(!existsSync(`${repository}web/${file}`), 'no such page');
		await page.setViewportSize({ width: 900, height: 500 });
		for (const language of ['en', 'zh']) {
			await load(page, `${file}${query}&lang=${language}`);
			for (const colorScheme of SCHEMES) {
				await page.emulateMedia({ colorScheme });
				expect(await findings(page), `${language}, ${colorScheme}`).toEqual([]);
			}
		}
	});
}
