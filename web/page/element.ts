/** Element by id. @throws Error if the page has none */
export function element<T extends HTMLElement>(id: string): T {
	const found = document.getElementById(id);
	if (!found) throw new Error(`#${id} is not in the page`);
	return found as T;
}

/** Sets the page's state, for tests and styles. */
export function setState(state: 'loading' | 'ready' | 'failed' | 'running' | 'done'): void {
	document.documentElement.dataset.state = state;
}
