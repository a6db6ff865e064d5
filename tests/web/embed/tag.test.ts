import { expect, it } from 'vitest';
import { tagOf } from '../../../web/embed/tag.ts';

it('writes attributes as markup, without those of the page', () => {
	const attributes = { id: 'try', src: 'models/a', controls: '', 'data-alt': 'fox', alt: 'A "fox" & a <bunny>' };
	const written = tagOf(Object.entries(attributes).map(([name, value]) => ({ name, value })));
	expect(written).toBe('<fur-view src="models/a" controls alt="A &quot;fox&quot; &amp; a <bunny>"></fur-view>');
});
