/** Table 1 by itself, for any page that wants it. */

import type { measureTable1, Table1Options } from '../../../web/measure/bench/table1.ts';
import { openModule } from '../../../web/tools/browser.mjs';
import { expect, site, test } from '../harness.ts';

/** The module, as the page has it. */
type Loaded = { loaded: { measureTable1: typeof measureTable1 } };

test('Table 1 is measured row by row, tells how far it is, and can be stopped', async ({ page }) => {
	await openModule(page, site, '/measure/bench/table1.ts');
	const { rows, shares, stopped } = await page.evaluate(
		async (options: Table1Options) => {
			const { measureTable1 } = (globalThis as unknown as Loaded).loaded;
			const shares: number[] = [];
			const rows = await measureTable1(options, new AbortController().signal, (share) => shares.push(share));
			const stop = new AbortController();
			const stopped = await measureTable1(options, stop.signal, () => stop.abort()).catch(({ name }) => name);
			return { rows, shares, stopped };
		},
		{ quick: true, rounds: 1, width: 48, height: 32, triangles: [512, 4608] },
	);
	expect(rows.map(({ triangles }) => triangles)).toEqual([512, 4608]);
	for (const { layered, ptm, ratio } of rows) {
		expect(layered.fps).toBeGreaterThan(0);
		// Of one round the ratio is that of its frames per second.
		expect(ptm.fps / layered.fps).toBeCloseTo(ratio, 6);
	}
	expect(shares).toEqual(shares.toSorted((a, b) => a - b));
	expect(shares.at(-1)).toBe(1);
	expect(stopped).toBe('AbortError');
});
