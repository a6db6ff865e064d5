/** `<fur-view>` to those who do not see it: its name, whether it is decoration, and the language of its words. */

import { expect, test } from '../harness.ts';
import { drawNothing } from '../inPage/gpu.ts';
import { type Site, serveView, TORUS, until, withView } from './host.ts';

let site: Site;

test.use({ viewport: { width: 400, height: 300 } });

test.beforeAll(async () => {
	site = await serveView();
});

test.afterAll(() => site?.close());

test('a name may be its aria-label, and an empty alt makes it decoration', async ({ page }) => {
	await drawNothing(page);
	await site.open(page, `<fur-view ${TORUS} aria-label="Un anneau"></fur-view><button>After</button>`);
	await until(page, 'ready');
	const view = page.locator('fur-view');
	const picture = view.locator('canvas');
	await expect(picture).toHaveAccessibleName('Un anneau');
	await withView(page, (view) => view.setAttribute('alt', 'A ring'));
	await expect(picture).toHaveAccessibleName('A ring');
	const stops = async () => {
		await page.evaluate(() => {
			document.body.tabIndex = -1;
			document.body.focus();
		});
		const found: string[] = [];
		while (found.at(-1) !== 'After' && found.length < 9) {
			await page.keyboard.press('Tab');
			found.push(
				await page.evaluate(() => {
					const { activeElement } = document;
					const inner = activeElement?.shadowRoot?.activeElement;
					return inner ? inner.localName : `${activeElement?.textContent}`;
				}),
			);
		}
		return found;
	};
	expect(await stops()).toEqual(['canvas', 'After']);
	await withView(page, (view) => view.setAttribute('alt', ''));
	expect(await view.ariaSnapshot()).toBe('');
	expect(await stops()).toEqual(['After']);
	await withView(page, (view) => view.setAttribute('controls', ''));
	await expect(view).toMatchAriaSnapshot(`
		- group "Light and view":
		  - button "Turn the view by dragging"
		  - button "Light and view as they were"
	`);
	expect(await stops()).toEqual(['button', 'button', 'After']);
});

test('its own words have a language, those of the page that of the page', async ({ page }) => {
	await drawNothing(page);
	await site.open(page, `<section lang="fr"><fur-view ${TORUS} alt="Un anneau" controls></fur-view></section>`);
	await until(page, 'ready');
	const language = (part: string) =>
		page
			.locator('fur-view')
			.locator(part)
			.evaluate((element) => {
				for (let at: Element | null = element; at; ) {
					if (at.hasAttribute('lang')) return at.getAttribute('lang');
					at = at.parentElement ?? ((at.getRootNode() as ShadowRoot).host as Element);
				}
				return null;
			});
	for (const part of ['#hint', '.tools', 'button >> nth=0']) expect(await language(part), part).toBe('en');
	expect(await language('canvas')).toBe('fr');
	await withView(page, (view) => view.removeAttribute('alt'));
	expect(await language('canvas')).toBe('en');
});
