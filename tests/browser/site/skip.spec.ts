/** Pages whose links come first have a link past them. */

import { expect, site, state, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';

test.use({ viewport: { width: 900, height: 600 } });

for (const [file, words] of [
	['learn.html?still=1&lang=en', 'Skip to the content'],
	['bench.html?lang=zh', '跳到正文'],
	['embed.html?lang=en', 'Skip to the content'],
	['docs/options.html', 'Skip to the content'],
] as const)
	test(`the first stop of ${file} leads past its links`, async ({ page }) => {
		await drawNothing(page);
		await page.goto(site + file);
		await expect.poll(() => state(page)).not.toBe('loading');
		const skip = page.getByRole('link', { name: words });
		await page.keyboard.press('Tab');
		await expect(skip).toBeFocused();
		await expect(skip).toHaveCSS('clip-path', 'none');
		await page.keyboard.press('Enter');
		await page.keyboard.press('Tab');
		expect(await page.evaluate(() => document.activeElement?.closest('main') !== null)).toBe(true);
		await expect(skip).toHaveCSS('clip-path', 'inset(50%)');
	});
