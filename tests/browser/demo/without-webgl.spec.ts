import { expect, open, state, test } from '../harness.ts';

test('without WebGL2 there are words and a picture', async ({ page, watch }) => {
	await open(page, '');
	expect(await state(page)).toBe('failed');
	await expect(page.getByRole('heading', { name: 'This page needs WebGL2' })).toBeVisible();
	await expect(page.locator('#picture')).toHaveCount(0);
	await expect(page.getByRole('img', { name: /bunny/ })).toBeVisible();
	expect(watch.requests.filter((url) => url.endsWith('.gltf'))).toEqual([]);
});

test('a missing picture leaves the words alone', async ({ page, watch }) => {
	await page.route('**/still.jpg', (route) => route.fulfill({ status: 200, body: '' }));
	await open(page, '');
	await expect(page.getByRole('heading', { name: 'This page needs WebGL2' })).toBeVisible();
	await expect(page.locator('#fallback img')).toHaveCount(0);
	expect(watch.complaints).toEqual([]);
});

test('the lesson can be read without WebGL2', async ({ page }) => {
	await open(page, 'learn.html?lang=en');
	expect(await state(page)).toBe('failed');
	await expect(page.getByRole('heading', { name: 'Why shells?' })).toBeVisible();
	await expect(page.locator('figure[data-figure]').first()).toContainText('needs WebGL2');
});
