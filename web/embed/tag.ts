/** The tag of a view as text. */

/** Line that defines the element. */
export const SCRIPT = '<script type="module" src="fur-view.js"></script>';

const escaped = (text: string) => text.replaceAll('&', '&amp;').replaceAll('"', '&quot;');

/** Files and folders that a view wants beside its page; `fur-view.js` is one of them. */
export function filesOf(attributes: Iterable<{ name: string; value: string }>): string[] {
	const { src = '', preset } = Object.fromEntries([...attributes].map(({ name, value }) => [name, value]));
	const folder = src.replace(/[^/]*\.gltf$/, '').replace(/\/?$/, '/');
	const models = folder.replace(/[^/]*\/$/, '');
	const pelt = preset ? [`${models}models.json`, `${models}pelt-${preset}/`] : [];
	return ['fur-view.js', folder, ...pelt];
}

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
