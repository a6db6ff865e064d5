import { difference, expect, open, picture, state, test } from '../harness.ts';
import { drawNothing, shrinkPicture } from '../inPage/gpu.ts';

test('crowd=8 shows eight bodies in a few draw calls more than one', async ({ page }) => {
	await drawNothing(page);
	const drawn = async (query: string) => {
		await open(page, `?model=sphere&still=1${query}`);
		expect(await state(page)).toBe('ready');
		await expect(page.locator('#overlay')).toContainText(/draw calls · [\d,]+ triangles/);
		const text = (await page.locator('#overlay').textContent()) ?? '';
		const [, calls, triangles] = /(\d+) draw calls · ([\d,]+) triangles/.exec(text) ?? [];
		return { calls: Number(calls), triangles: Number(triangles?.replaceAll(',', '')) };
	};
	const one = await drawn('&crowd=1&shells=6');
	const plain = await drawn('&shells=6');
	expect(one).toEqual(plain);
	const eight = await drawn('&crowd=8');
	// The lawn; and shadows, skin, fins and shells of two levels at most.
	expect(eight.calls).toBeLessThanOrEqual(one.calls + 4);
	expect(eight.triangles).toBeGreaterThan(5 * one.triangles);
});

test('the light goes round a crowd, too', async ({ page }) => {
	const at = '?model=sphere&crowd=6&still=1&ui=0&camera=0,20,0.6';
	await open(page, `${at}&light=-1,0.2,0.1`);
	const left = await picture(page);
	await open(page, `${at}&light=1,0.2,0.1`);
	expect(difference(left, await picture(page))).toBeGreaterThan(3);
});

test('the lamp of a crowd is in the first picture', async ({ page }) => {
	await page.setViewportSize({ width: 900, height: 600 });
	await open(page, '?model=sphere&crowd=25&shells=1&fins=0&still=1&colour=050505,0a0a0a&light=-.7,.6,.3');
	const { width, brightness } = await picture(page.locator('#picture'));
	// Below the header, between the tools and the panel.
	const seen = brightness.filter((_, i) => Math.floor(i / width) > 90 && i % width > 90 && i % width < 600);
	expect(seen.reduce((most, each) => Math.max(most, each), 0)).toBeGreaterThan(150);
});

test('a link leads close to one body of a crowd', async ({ page }) => {
	await drawNothing(page);
	await open(page, '?model=sphere&shells=4&camera=0,10,0.09&crowd=20&still=1');
	await page.locator('#picture').press('+');
	// Nearer from there, and not from where it would stand beside a body alone.
	await expect
		.poll(() => Number(new URL(page.url()).searchParams.get('camera')?.split(',')[2]), { timeout: 5000 })
		.toBeLessThan(0.1);
});

test('the panel makes a crowd, and makes it go', async ({ page }) => {
	await page.setViewportSize({ width: 900, height: 600 });
	await shrinkPicture(page, 160, 120, [240, 120]);
	const shown = () => picture(page.locator('#picture'));
	await open(page, '?model=sphere&shells=6&still=1&light=1,.3,.5&camera=0,10,1');
	const before = await shown();
	const count = page.getByLabel('Crowd', { exact: true });
	const shells = page.getByLabel('Shells', { exact: true });
	await count.fill('5');
	await count.press('Enter');
	await expect.poll(() => new URL(page.url()).searchParams.get('crowd')).toBe('5');
	await expect(shells).toBeDisabled();
	expect(difference(before, await shown())).toBeGreaterThan(3);
	await count.fill('1');
	await count.press('Enter');
	await expect.poll(() => new URL(page.url()).searchParams.get('crowd')).toBe(null);
	await expect(shells).toBeEnabled();
	await expect.poll(async () => difference(before, await shown())).toBeLessThan(1);
});

test('another model comes as the same crowd', async ({ page }) => {
	await drawNothing(page);
	await page.setViewportSize({ width: 900, height: 600 });
	await shrinkPicture(page, 160, 120, [240, 120]);
	await open(page, '?model=sphere&crowd=3&still=1&light=1,.3,.5');
	await page.getByRole('combobox', { name: 'Model' }).selectOption('Torus');
	await expect.poll(() => new URL(page.url()).searchParams.get('model')).toBe('torus');
	await expect.poll(() => state(page)).toBe('ready');
	expect(new URL(page.url()).searchParams.get('crowd')).toBe('3');
});
