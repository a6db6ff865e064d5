/** The element of that id. @throws Error where the page has none */
export function element<T extends HTMLElement>(id: string): T {
	const found = document.getElementById(id);
	if (!found) throw new Error(`#${id} is not in the page`);
	return found as T;
}

/** The page's own word on what it shows, for tests and for styles. */
export function setState(state: 'loading' | 'ready' | 'failed' | 'running' | 'done'): void {
	document.documentElement.dataset.state = state;
}
