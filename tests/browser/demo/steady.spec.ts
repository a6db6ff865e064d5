/** What frames cost besides drawing: nothing is uploaded, nothing is allocated; and none of them leaps. */

import type { Page } from '@playwright/test';
import { openModule } from '../../../web/tools/browser.mjs';
import { expect, frames, open, site, test } from '../harness.ts';
import { drawNothing, watchGpu } from '../inPage/gpu.ts';
import { served } from '../library.ts';
import { calm, hasten, psnr, restyle, shot } from '../robust.ts';

declare const loaded: typeof import('../inPage/breeze.ts');

test.use({ viewport: { width: 80, height: 60 } });

interface Allocations {
	callFrame: { url: string };
	selfSize: number;
	children: Allocations[];
}

/** Bytes that the page's and the library's own files have asked for. */
const own = ({ callFrame, selfSize, children }: Allocations): number =>
	(/\/(demo|fur|page)\/(\w+\/)*\w+\.ts/.test(callFrame.url) ? selfSize : 0) +
	children.reduce((sum, child) => sum + own(child), 0);

/** Frames as the page draws them keep nothing, and throw nothing away. */
async function expectNoBytes(page: Page): Promise<void> {
	const devtools = await page.context().newCDPSession(page);
	await devtools.send('HeapProfiler.enable');
	const heap = async () => {
		for (let i = 0; i < 2; i++) await devtools.send('HeapProfiler.collectGarbage');
		return (await devtools.send('Runtime.getHeapUsage')).usedSize;
	};
	const sampling = {
		samplingInterval: 256,
		includeObjectsCollectedByMajorGC: true,
		includeObjectsCollectedByMinorGC: true,
	};
	// Until the engine has compiled what runs often: before that every fraction is an object.
	await frames(page, 400);
	let [kept, thrown] = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
	// Its code and notes take room, too, now and then; what the page keeps it keeps every time. What runs once a frame is
	// compiled late.
	for (let stretch = 0; stretch < 16 && (kept > 40 || thrown > 1000); stretch++) {
		const before = await heap();
		await devtools.send('HeapProfiler.startSampling', sampling);
		await frames(page, 600);
		const { profile } = await devtools.send('HeapProfiler.stopSampling');
		kept = Math.min(kept, ((await heap()) - before) / 600);
		thrown = Math.min(thrown, own(profile.head) / 600);
	}
	// Fewer bytes per frame than the smallest object; and in the page's own files a few fractions, no more.
	expect(kept, 'bytes kept per frame').toBeLessThan(40);
	expect(thrown, 'bytes thrown away per frame').toBeLessThan(1000);
}

test('a moving light uploads neither texture nor buffer', async ({ page }) => {
	await watchGpu(page);
	await open(page, calm.replace('ui=0', 'ui=1'));
	const before = await shot(page);
	await page.evaluate(() => {
		window.gpu.uploads = {};
	});
	for (let i = 0; i < 40; i++) {
		await page.keyboard.press('Shift+ArrowRight');
		await frames(page, 1);
	}
	expect(psnr(before, await shot(page))).toBeLessThan(40);
	expect(await page.evaluate(() => window.gpu.uploads)).toEqual({});
});

test('steady frames under a moving light allocate nothing', async ({ page }) => {
	// The page's own memory knows nothing of pixels.
	await drawNothing(page);
	await hasten(page);
	// From its sources, whose names tell the page's own allocations from three's.
	await open(page, 'sources.html?model=torus-512&shells=2');
	await expectNoBytes(page);
});

test('frames of fur in the wind allocate nothing', async ({ page }) => {
	await hasten(page);
	await openModule(page, site, served('tests/browser/inPage/breeze.ts'));
	await page.evaluate((url) => loaded.blow(url), served('public/models/torus-512/model.gltf'));
	await expectNoBytes(page);
});

test('the light does not jump after a hidden tab', async ({ page }) => {
	// Frames only when asked for, at a time that the test says.
	await page.addInitScript(() => {
		const own = requestAnimationFrame;
		const waiting: FrameRequestCallback[] = [];
		const clock = { now: performance.now(), held: false };
		window.requestAnimationFrame = (callback) => {
			if (clock.held) return waiting.push(callback);
			return own(() => {
				clock.now += 16;
				callback(clock.now);
			});
		};
		Object.assign(window, {
			hold: () => {
				clock.held = true;
			},
			tick: (milliseconds: number) => {
				clock.now += milliseconds;
				for (const callback of waiting.splice(0)) callback(clock.now);
			},
		});
	});
	await open(page, calm.replace('still=1', 'still=0').replace('light=-.8,.5,.3', ''));
	await page.evaluate(() => (window as unknown as { hold(): void }).hold());
	// Where its light falls, at whatever resolution: a busy machine's is lowered meanwhile.
	await restyle(page, 'canvas { filter: blur(8px) }');
	await page.waitForTimeout(400);
	const tick = async (milliseconds: number, count = 1) => {
		for (let i = 0; i < count; i++)
			await page.evaluate((ms) => (window as unknown as { tick(ms: number): void }).tick(ms), milliseconds);
		await page.waitForTimeout(200);
		return page.screenshot(); // no frame comes by itself
	};
	const before = await tick(16);
	const after = await tick(3_600_000);
	const later = await tick(100, 40);
	expect(psnr(before, after)).toBeGreaterThan(psnr(before, later) + 6);
	expect(psnr(before, after)).toBeLessThan(Number.POSITIVE_INFINITY);
});
