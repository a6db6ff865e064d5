/** The page of the tag: what its buttons say, and to whom. */

import { expect, open, site, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';

test.use({ viewport: { width: 700, height: 600 } });

test('a button that copies says so to eyes and ears', async ({ page }) => {
	await drawNothing(page);
	await page.context().grantPermissions(['clipboard-read', 'clipboard-write'], { origin: new URL(site).origin });
	await open(page, 'embed.html?lang=en');
	const button = page.locator('#try ~ .copy button');
	await expect(button).toHaveAccessibleName('Copy this: A furry bunny under a lamp');
	await button.press('Enter');
	await expect(button).toHaveText('Copied');
	await expect(button).toHaveAccessibleName('Copied: A furry bunny under a lamp');
	const said = page.locator('#said');
	await expect(said).toHaveRole('status');
	await expect(said).toHaveText('Copied: A furry bunny under a lamp');
	expect(await page.evaluate(() => navigator.clipboard.readText())).toContain('<fur-view');
	await expect(button).toHaveAccessibleName('Copy this: A furry bunny under a lamp');
	await expect(said).toHaveText('');
});
