import { existsSync } from 'node:fs';
import { expect, it } from 'vitest';
import { filesOf, tagOf } from '../../../web/embed/tag.ts';

it('writes attributes as markup, without those of the page', () => {
	const attributes = { id: 'try', src: 'models/a', controls: '', 'data-alt': 'fox', alt: 'A "fox" & a <bunny>' };
	const written = tagOf(Object.entries(attributes).map(([name, value]) => ({ name, value })));
	expect(written).toBe('<fur-view src="models/a" controls alt="A &quot;fox&quot; &amp; a <bunny>"></fur-view>');
});

it.each([
	[{ src: 'models/torus/model.gltf' }, ['fur-view.js', 'models/torus/']],
	[{ src: 'models/torus' }, ['fur-view.js', 'models/torus/']],
	[
		{ src: 'models/bunny/model.gltf', preset: 'fox' },
		['fur-view.js', 'models/bunny/', 'models/models.json', 'models/pelt-fox/'],
	],
])('%j wants files beside its page that are there', (attributes, expected) => {
	const files = filesOf(Object.entries(attributes).map(([name, value]) => ({ name, value })));
	expect(files).toEqual(expected);
	for (const file of files.slice(1)) expect(existsSync(new URL(`../../../public/${file}`, import.meta.url))).toBe(true);
});
