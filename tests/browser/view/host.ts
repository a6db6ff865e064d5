/** Pages with `<fur-view>` from its one file and nothing else, under the strictest policy that serves scripts at all. */

import { mkdirSync, mkdtempSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import { build } from 'vite';
import type { FurView } from '../../../web/view/view.d.ts';
import { type Host, serveFolder } from '../host.ts';

const at = (path: string) => fileURLToPath(new URL(`../../../${path}`, import.meta.url));

/** Attributes of a view of a ring of fur. */
export const TORUS = 'src="models/torus-512/model.gltf" camera="20,38,0.9"';

export interface Site extends Host {
	/** Writes a file of the site. */
	write(path: string, text: string | Uint8Array): void;
	/** Writes a page with some markup in its body, and opens it. */
	open(page: Page, body: string): Promise<void>;
}

/** Builds the file and serves it. */
export async function serveView(): Promise<Site> {
	const folder = mkdtempSync(join(tmpdir(), 'furbake-view-'));
	await build({ configFile: at('web/vite.view.config.ts'), logLevel: 'error', build: { outDir: folder } });
	symlinkSync(at('public/models'), join(folder, 'models'), 'junction');
	const write: Site['write'] = (path, text) => {
		mkdirSync(dirname(join(folder, path)), { recursive: true });
		writeFileSync(join(folder, path), text);
	};
	write('_headers', "/*\n  Content-Security-Policy: default-src 'self'\n");
	write('404.html', '');
	write('icon.svg', '<svg xmlns="http://www.w3.org/2000/svg"/>');
	write(
		'page.css',
		'body { margin: 0 } main { display: flex; flex-wrap: wrap } fur-view { width: 100px; height: 75px } .far, h1 { width: 100% } .far { height: 2000px }',
	);
	const host = await serveFolder(folder, '/');
	let pages = 0;
	return {
		...host,
		write,
		async open(page, body) {
			await page.addInitScript(() => {
				addEventListener('securitypolicyviolation', ({ effectiveDirective, blockedURI }) => {
					console.warn(`policy: ${effectiveDirective} stops ${blockedURI}`);
				});
			});
			// The host keeps what it has sent.
			const name = `${++pages}.html`;
			write(
				name,
				`<!doctype html><html lang="en"><meta charset="utf-8"><title>A page of someone else's</title>
				<link rel="icon" href="icon.svg"><link rel="stylesheet" href="page.css">
				<script type="module" src="fur-view.js"></script><main><h1>Fur</h1>${body}</main></html>`,
			);
			await page.goto(host.address + name);
		},
		close() {
			host.close();
			rmSync(folder, { recursive: true, force: true });
		},
	};
}

/** Waits until a view has come to a state. */
export async function until(page: Page, state: FurView['state'], selector = 'fur-view'): Promise<void> {
	await page.waitForFunction(
		([selector, state]) => document.querySelector<FurView>(selector as string)?.state === state,
		[selector, state],
		{ timeout: 120_000 },
	);
}

/** Pixels of a view: share of those that are warmer than the blue backdrop, and mean contrast between these and their neighbours. */
export function pixels(page: Page, selector = 'fur-view'): Promise<{ covered: number; contrast: number }> {
	return page.locator(`${selector} canvas`).evaluate((canvas: HTMLCanvasElement) => {
		const { width, height } = canvas;
		const copy = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
		copy?.drawImage(canvas, 0, 0);
		const data = copy?.getImageData(0, 0, width, height).data ?? [];
		const value = (at: number) => (data[at] ?? 0) + (data[at + 1] ?? 0) + (data[at + 2] ?? 0);
		const warm = (at: number) => (data[at] ?? 0) > (data[at + 2] ?? 0);
		let [count, contrast] = [0, 0];
		for (let at = 4; at < data.length; at += 4) {
			if (!warm(at) || !warm(at - 4)) continue;
			count++;
			contrast += Math.abs(value(at) - value(at - 4)) / 3;
		}
		return { covered: count / (width * height), contrast: contrast / Math.max(count, 1) };
	});
}

/** Counts frames that are drawn, and contexts. */
export async function watchDraws(page: Page): Promise<void> {
	await page.addInitScript(() => {
		const counts = { draws: 0, contexts: [] as WebGL2RenderingContext[] };
		Object.assign(window, { counts });
		const { drawElements } = WebGL2RenderingContext.prototype;
		WebGL2RenderingContext.prototype.drawElements = function (...args) {
			counts.draws++;
			drawElements.apply(this, args);
		};
		const { getContext } = HTMLCanvasElement.prototype;
		HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...args: [string, object?]) {
			const context = getContext.apply(this, args as ['webgl2']);
			if (context instanceof WebGL2RenderingContext && !counts.contexts.includes(context))
				counts.contexts.push(context);
			return context;
		} as typeof getContext;
	});
}

export interface Counts {
	draws: number;
	contexts: WebGL2RenderingContext[];
}

/** Reads what is counted. */
export const counts = <T>(page: Page, read: (counts: Counts) => T) =>
	page.evaluate(`(${read})(window.counts)`) as Promise<T>;

/** Runs with the first view of the page. */
export const withView = <T>(page: Page, act: (view: FurView) => T, selector = 'fur-view') =>
	page
		.locator(selector)
		.first()
		.evaluate(act as (element: HTMLElement) => T);
