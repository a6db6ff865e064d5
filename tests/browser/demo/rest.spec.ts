/** Frames are drawn while something moves, and none at rest. */

import type { Page } from '@playwright/test';
import { expect, open, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';

test.use({ viewport: { width: 160, height: 120 } });

/** Counts what is drawn. */
async function countDraws(page: Page): Promise<() => Promise<number>> {
	await page.addInitScript(() => {
		const { prototype } = WebGL2RenderingContext;
		const own = prototype.drawElementsInstanced;
		Object.assign(window, { draws: 0 });
		prototype.drawElementsInstanced = function (...given) {
			(window as unknown as { draws: number }).draws++;
			return own.apply(this, given);
		};
	});
	return () => page.evaluate(() => (window as unknown as { draws: number }).draws);
}

test('skin comes first, then fur; at rest nothing is drawn, until a key, the window or the tab asks for it', async ({
	page,
}) => {
	await drawNothing(page);
	const draws = await countDraws(page);
	await open(page, '?model=torus-512&shells=2');
	const marks = await page.evaluate(() =>
		['furbake:skin', 'furbake:fur'].map((name) => performance.getEntriesByName(name)[0]?.startTime ?? Number.NaN),
	);
	expect(marks[0]).toBeLessThanOrEqual(marks[1] ?? 0);
	const drifting = await draws();
	await expect.poll(draws).toBeGreaterThan(drifting);
	await expect(page.locator('#overlay')).toContainText(/\d+ fps · [\d.]+ ms/);
	const rest = async () => {
		await expect(page.locator('#overlay')).toContainText('at rest');
		const before = await draws();
		await page.waitForTimeout(400);
		expect(await draws()).toBe(before);
		return before;
	};
	await page.keyboard.press('ArrowRight');
	let before = await rest();
	expect(await page.locator('#overlay').textContent()).toMatch(/[\d.]+ MB of textures/);
	for (const wake of [
		() => page.keyboard.press('ArrowLeft'),
		() => page.setViewportSize({ width: 180, height: 120 }),
		() => page.evaluate(() => document.dispatchEvent(new Event('visibilitychange'))),
		() => page.mouse.click(90, 60),
	]) {
		await wake();
		await expect.poll(draws).toBeGreaterThan(before);
		before = await rest();
	}
});
