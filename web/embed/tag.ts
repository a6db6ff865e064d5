/** The tag of a view as text. */

/** Line that defines the element. */
export const SCRIPT = '<script type="module" src="fur-view.js"></script>';

const escaped = (text: string) => text.replaceAll('&', '&amp;').replaceAll('"', '&quot;');

/**
 * Tag with the attributes of a view, as its markup would have them.
 *
 * @param attributes names and values in order; those of this page alone are left out
 */
export function tagOf(attributes: Iterable<{ name: string; value: string }>): string {
	const own = [...attributes].filter(({ name }) => name !== 'id' && !name.startsWith('data-'));
	const written = own.map(({ name, value }) => (value === '' ? ` ${name}` : ` ${name}="${escaped(value)}"`));
	return `<fur-view${written.join('')}></fur-view>`;
}
