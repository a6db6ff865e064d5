/** Whiskers that are narrower than a pixel: whole lines as long as they cover most of it, and shorter the less they do. */

import { expect, test } from '../harness.ts';
import { openInPage } from '../library.ts';

declare const loaded: typeof import('../inPage/thin.ts');

test('a whisker of less than a pixel is a line, not dots', async ({ page }) => {
	await openInPage(page, 'thin');
	const columns = (kept: boolean, radius: number, turn: number) =>
		page.evaluate((of) => loaded.whisker(...of), [kept, radius, turn] as [boolean, number, number]);
	/** Length up to the last lit column, and columns without a pixel on the way. */
	const line = (lit: number[]) => {
		const length = lit.findLastIndex((count) => count > 0) + 1;
		return { length, gaps: lit.slice(0, length).filter((count) => count === 0).length };
	};
	for (const turn of [0, 4, 17, 38]) {
		const whole = line(await columns(false, 3, turn));
		const wide = await columns(true, 3, turn);
		expect(line(wide), 'one that is wider stays as it is').toEqual(whole);
		const kept = line(await columns(true, 0.4, turn));
		expect(kept.gaps, `${turn}°`).toBe(0);
		expect(kept.length).toBeGreaterThan(0.85 * whole.length);
		const faint = line(await columns(true, 0.25, turn));
		expect(faint.gaps, `${turn}°, far`).toBe(0);
		expect(faint.length).toBeGreaterThan(0.2 * whole.length);
		expect(faint.length).toBeLessThan(0.8 * whole.length);
		expect(line(await columns(true, 0.09, turn)).length, 'gone').toBe(0);
	}
	const dots = await Promise.all([4, 17, 38].map((turn) => columns(false, 0.4, turn)));
	expect(Math.max(...dots.map((lit) => line(lit).gaps))).toBeGreaterThan(3);
});
