import type { Page } from '@playwright/test';
import { decode } from 'fast-png';
import { shrinkPicture, watchGpu } from './gpu.ts';
import { expect, open, state, test } from './harness.ts';

test.use({ viewport: { width: 200, height: 160 } });

/** A light model, lit from the side. */
const calm = '?model=sphere&shells=6&still=1&ui=0&light=-.8,.5,.3';

const shot = (page: Page) => page.screenshot();

/** Decibels between two pictures of one size; Infinity for the same. */
function psnr(a: Buffer, b: Buffer): number {
	const [one, other] = [decode(a), decode(b)];
	expect([other.width, other.height]).toEqual([one.width, one.height]);
	let sum = 0;
	one.data.forEach((value, i) => {
		sum += (value - (other.data[i] ?? 0)) ** 2;
	});
	return 10 * Math.log10(255 ** 2 / (sum / one.data.length));
}

/** Mean and spread of the brightness of the picture's middle: a blank one has none. */
function middle(png: Buffer): { mean: number; spread: number } {
	const { width, height, channels, data } = decode(png);
	const values: number[] = [];
	for (let y = Math.round(height * 0.4); y < height * 0.6; y++)
		for (let x = Math.round(width * 0.4); x < width * 0.6; x++) values.push(data[(y * width + x) * channels] ?? 0);
	const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
	return { mean, spread: Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / values.length) };
}

const canvasWidth = (page: Page) => page.evaluate(() => document.querySelector('canvas')?.width);

interface Allocations {
	callFrame: { url: string };
	selfSize: number;
	children: Allocations[];
}

/** Bytes that the page's and the library's own files have asked for. */
const own = ({ callFrame, selfSize, children }: Allocations): number =>
	(/\/(demo|fur)\/\w+\.ts/.test(callFrame.url) ? selfSize : 0) + children.reduce((sum, child) => sum + own(child), 0);

/** @param count of the page's own frames */
const frames = (page: Page, count: number) =>
	page.evaluate(
		(count) =>
			new Promise<void>((resolve) => {
				const next = (left: number) => (left > 0 ? requestAnimationFrame(() => next(left - 1)) : resolve());
				next(count);
			}),
		count,
	);

/** Takes the context away and gives it back. */
async function loseContext(page: Page): Promise<void> {
	await page.evaluate(() => {
		const gl = document.querySelector('canvas')?.getContext('webgl2');
		const switched = gl?.getExtension('WEBGL_lose_context');
		Object.assign(window, { giveBack: () => switched?.restoreContext() });
		switched?.loseContext();
	});
	await expect.poll(() => state(page)).toBe('loading');
	await page.waitForTimeout(300);
	expect(await state(page)).toBe('loading');
	await page.evaluate(() => (window as unknown as { giveBack(): void }).giveBack());
	await expect.poll(() => state(page)).toBe('ready');
}

for (const [what, query] of [
	['one body', calm],
	['a crowd', `${calm}&crowd=3`],
] as const) {
	test(`a lost context comes back to the same picture of ${what}`, async ({ page }) => {
		await open(page, query);
		// Bodies of a crowd know the picture's height from its first frame on.
		for (const key of ['ArrowRight', 'ArrowLeft']) {
			await page.keyboard.press(key);
			await frames(page, 3);
		}
		const before = await shot(page);
		expect(middle(before).spread).toBeGreaterThan(2);
		for (let i = 0; i < 2; i++) {
			await loseContext(page);
			expect(psnr(before, await shot(page))).toBeGreaterThan(45);
		}
		// What belonged to the lost context is let go of without a word.
		await page.setViewportSize({ width: 220, height: 160 });
		await expect.poll(() => canvasWidth(page)).toBe(220);
	});
}

test('a lost context comes back while frames run, and the page goes on', async ({ page }) => {
	await page.setViewportSize({ width: 900, height: 500 });
	await shrinkPicture(page, 160, 120);
	await open(page, '?model=sphere&shells=4&light=-.8,.5,.3');
	await page.keyboard.press('ArrowRight');
	const rested = async () => {
		let last: Buffer = Buffer.alloc(0);
		await expect(async () => {
			const now = await page.locator('#picture').screenshot();
			const same = now.equals(last);
			last = now;
			expect(same && (await canvasWidth(page)) === 160).toBe(true);
		}).toPass({ intervals: [900] });
		return last;
	};
	const before = await rested();
	await loseContext(page);
	expect(psnr(before, await rested())).toBeGreaterThan(45);
	// What belonged to the lost context is let go of without a word.
	await page.getByRole('combobox', { name: 'Model' }).selectOption('Torus');
	await expect.poll(() => state(page)).toBe('ready');
	await page.evaluate(() => document.getElementById('shrink')?.remove());
	await expect.poll(() => canvasWidth(page)).toBe(900);
	await frames(page, 3);
	await expect(page.locator('#overlay')).toContainText(/\d+ draw calls/);
});

test('50 rounds of loading and disposing leave the GPU as many objects as before', async ({ page }) => {
	test.setTimeout(400_000);
	await page.setViewportSize({ width: 900, height: 500 });
	await shrinkPicture(page, 48, 36);
	await watchGpu(page);
	await open(page, '?model=sphere&shells=2&still=1');
	const counts: Record<string, number>[] = [];
	for (let round = 0; round < 50; round++) {
		await page.evaluate(() => {
			document.documentElement.dataset.state = 'loading';
		});
		await page.getByRole('combobox', { name: 'Model' }).selectOption(round % 2 === 0 ? 'Torus' : 'Sphere');
		await expect.poll(() => state(page), { intervals: [20, 50] }).toBe('ready');
		if (round % 2 === 1) counts.push(await page.evaluate(() => window.gpu.live()));
	}
	expect(Object.values(counts[0] ?? {}).reduce((sum, count) => sum + count, 0)).toBeGreaterThan(20);
	for (const later of counts.slice(1)) expect(later).toEqual(counts[0]);
});

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
	test.setTimeout(400_000);
	await shrinkPicture(page, 48, 36);
	await open(page, '?model=sphere&shells=2');
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
	// Its code and notes take room, too, now and then; what the page keeps it keeps every time.
	for (let stretch = 0; stretch < 4 && (kept > 40 || thrown > 1000); stretch++) {
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
});

test('the picture follows the window, the layout and the pixels of the screen', async ({ page }) => {
	await open(page, calm);
	expect(await canvasWidth(page)).toBe(200);
	await page.setViewportSize({ width: 240, height: 160 });
	await expect.poll(() => canvasWidth(page)).toBe(240);
	await page.addStyleTag({ content: '#picture { width: 50% !important }' });
	await expect.poll(() => canvasWidth(page)).toBe(120);
	await frames(page, 2);
	expect(middle(await page.locator('#picture').screenshot()).spread).toBeGreaterThan(2);

	const devtools = await page.context().newCDPSession(page);
	const screen = async (deviceScaleFactor: number) => {
		const metrics = { width: 240, height: 160, deviceScaleFactor, mobile: false };
		await devtools.send('Emulation.setDeviceMetricsOverride', metrics);
		// A page that draws nothing new hears of it with the next picture that is taken of it.
		await devtools.send('Page.captureScreenshot');
	};
	await screen(2);
	await expect.poll(() => canvasWidth(page)).toBe(240);
	await screen(1.5);
	await expect.poll(() => canvasWidth(page)).toBe(180);
	await screen(3);
	await expect.poll(() => canvasWidth(page), 'no more than two pixels per CSS pixel').toBe(240);
	expect(await state(page)).toBe('ready');
});

test('a canvas without size is no error, and comes back', async ({ page }) => {
	await open(page, calm);
	const before = await shot(page);
	for (const hidden of ['display: none', 'width: 0', 'height: 0']) {
		const style = await page.addStyleTag({ content: `#picture { ${hidden} !important }` });
		await page.keyboard.press('ArrowRight');
		await page.keyboard.press('ArrowLeft');
		await frames(page, 3);
		await style.evaluate((element) => (element as Element).remove());
		await frames(page, 4);
		expect(psnr(before, await shot(page)), hidden).toBeGreaterThan(45);
	}
});

test('a page that opens without size shows its picture when it gets one', async ({ page }) => {
	await open(page, calm);
	const early = await shot(page);
	await shrinkPicture(page, 0, 0);
	await open(page, calm);
	expect(await state(page)).toBe('ready');
	await page.evaluate(() => document.getElementById('shrink')?.remove());
	await expect.poll(async () => middle(await shot(page)).spread).toBeGreaterThan(2);
	await frames(page, 3);
	expect(psnr(early, await shot(page))).toBeGreaterThan(45);
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
	await page.waitForTimeout(400);
	const tick = async (milliseconds: number, count = 1) => {
		for (let i = 0; i < count; i++)
			await page.evaluate((ms) => (window as unknown as { tick(ms: number): void }).tick(ms), milliseconds);
		await page.waitForTimeout(200);
		return shot(page);
	};
	const before = await tick(16);
	const after = await tick(3_600_000);
	const later = await tick(100, 40);
	expect(psnr(before, after)).toBeGreaterThan(psnr(before, later) + 6);
	expect(psnr(before, after)).toBeLessThan(Number.POSITIVE_INFINITY);
});

test.describe('poorer GPUs', () => {
	const floats = ['EXT_color_buffer_float', 'EXT_color_buffer_half_float'];

	test('without float targets the fur shows in eight bits', async ({ page, browser, watch }) => {
		await open(page, calm);
		const best = await shot(page);
		const context = await browser.newContext({ viewport: page.viewportSize() });
		const poor = await context.newPage();
		poor.on('console', (message) => {
			if (['error', 'warning'].includes(message.type())) watch.complaints.push(message.text());
		});
		await watchGpu(poor, floats);
		await open(poor, calm);
		expect(await state(poor)).toBe('ready');
		const eight = await shot(poor);
		expect(middle(eight).spread).toBeGreaterThan(2);
		expect(psnr(best, eight)).toBeGreaterThan(20);
		expect(psnr(best, eight)).toBeLessThan(Number.POSITIVE_INFINITY);
		await loseContext(poor);
		expect(psnr(eight, await shot(poor))).toBeGreaterThan(45);
		await context.close();
		// three's own word about a table of its skin's shader is all that is allowed.
		expect(watch.complaints.filter((text) => !/EXT_color_buffer_float extension not supported/.test(text))).toEqual([]);
		watch.complaints.length = 0;
	});

	test('without timer and anisotropy everything else is there', async ({ page }) => {
		await watchGpu(page, ['EXT_disjoint_timer_query_webgl2', 'EXT_texture_filter_anisotropic']);
		await open(page, '?model=sphere&shells=2');
		await expect(page.locator('#overlay')).toContainText(/\d+ draw calls/);
		await expect(page.locator('#overlay canvas')).toHaveCount(2);
		await frames(page, 30);
		expect(middle(await shot(page)).spread).toBeGreaterThan(1);
		expect(await page.evaluate(() => window.gpu.anisotropy)).toEqual([]);
	});

	test('planes of shells are filtered along their slant', async ({ page }) => {
		await watchGpu(page);
		await open(page, calm);
		// The sphere's have a colour plane, too; those of its fins, and everything else, are not.
		expect(await page.evaluate(() => window.gpu.anisotropy)).toEqual([2, 2, 2]);
	});

	for (const [parameter, least, words] of [
		['MAX_ARRAY_TEXTURE_LAYERS', 8, /layers: got \d+ layers, expected at most 8 on this GPU/],
		['MAX_TEXTURE_SIZE', 32, /size: got tiles of 64 × 64 texels, expected at most 32 × 32 on this GPU/],
	] as const) {
		test(`an asset beyond ${parameter} gets one clear sentence, and the old model stays`, async ({ page }) => {
			await page.setViewportSize({ width: 900, height: 500 });
			await shrinkPicture(page, 160, 120);
			await watchGpu(page);
			await open(page, '?model=sphere&shells=4&still=1&light=-.8,.5,.3');
			const before = await page.locator('#picture').screenshot();
			await page.evaluate(([name, value]) => Object.assign(window.gpu.parameters, { [name]: value }), [
				parameter,
				least,
			] as const);
			await page.getByRole('combobox', { name: 'Model' }).selectOption('Torus');
			await expect(page.getByRole('status')).toContainText('Torus cannot be shown', { ignoreCase: true });
			await expect(page.getByRole('status')).toContainText(words);
			await expect(page.locator('.notice')).toHaveCount(1);
			await expect.poll(() => state(page)).toBe('ready');
			await expect(page.getByRole('combobox', { name: 'Model' })).toHaveValue('Sphere');
			expect(psnr(before, await page.locator('#picture').screenshot())).toBeGreaterThan(45);
		});
	}
});

test.describe('the governor', () => {
	const load = (page: Page, milliseconds: number) =>
		page.evaluate((milliseconds) => {
			window.gpu.time = (width) => milliseconds * (width / 160) ** 2;
		}, milliseconds);

	test('draws fewer pixels where frames take long, all of them where nothing moves', async ({ page }) => {
		await page.setViewportSize({ width: 400, height: 300 });
		await shrinkPicture(page, 160, 120);
		await watchGpu(page);
		await page.addInitScript(() => {
			window.gpu.time = () => 1;
		});
		await open(page, '?model=sphere&shells=2');
		await expect(page.locator('#overlay')).toContainText('full resolution');
		expect(await canvasWidth(page)).toBe(160);
		await load(page, 24);
		await expect.poll(() => canvasWidth(page)).toBe(113);
		await expect(page.locator('#overlay')).toContainText('71 % resolution');
		await load(page, 5);
		await expect.poll(() => canvasWidth(page)).toBe(160);
		await load(page, 200);
		await expect.poll(() => canvasWidth(page)).toBe(80);
		await page.keyboard.press('ArrowRight');
		await expect.poll(() => canvasWidth(page)).toBe(160);
		await expect(page.locator('#overlay')).toContainText('full resolution');
	});

	test('leaves pictures alone with still=1', async ({ page }) => {
		await watchGpu(page);
		await page.addInitScript(() => {
			window.gpu.time = () => 200;
		});
		await open(page, calm);
		for (let i = 0; i < 40; i++) {
			await page.keyboard.press('ArrowRight');
			await frames(page, 1);
		}
		expect(await canvasWidth(page)).toBe(200);
	});
});
