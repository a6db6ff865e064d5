/** `<fur-view>` where there is no WebGL2. */

import { expect, test } from '../harness.ts';
import { type Site, serveView, until } from './host.ts';

let site: Site;

test.beforeAll(async () => {
	site = await serveView();
});

test.afterAll(() => site?.close());

test('without WebGL2 there are words, the page’s own where it has some, and nothing is fetched', async ({
	page,
	watch,
}) => {
	const src = 'src="models/torus-512"';
	await page.addInitScript(() =>
		addEventListener(
			'error',
			({ target, message }) => {
				if (target instanceof HTMLElement) target.dataset.heard = message;
			},
			true,
		),
	);
	await site.open(
		page,
		`<fur-view ${src}></fur-view><fur-view id="own" ${src}><p slot="fallback">A ring of fur</p></fur-view>`,
	);
	await until(page, 'failed', '#own');
	await expect(page.getByText('needs WebGL2').first()).toBeVisible();
	await expect(page.getByText('A ring of fur')).toBeVisible();
	await expect(page.locator('#own')).toHaveAttribute('data-heard', 'fur-view: this browser has no WebGL2');
	expect(watch.requests.filter((url) => url.includes('/models/'))).toEqual([]);
	const warning = 'fur-view: this browser has no WebGL2 (src="models/torus-512")';
	expect(watch.complaints.splice(0)).toEqual([warning, warning]);
});
