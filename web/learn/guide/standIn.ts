/** Button in the place of a figure that is not built yet: it has the figure's name and its turn of the Tab key. */

/** Elements that the Tab key stops at; of radio buttons the checked one, if any. */
const STOPS =
	'a[href], button:enabled, [tabindex="0"], input:not([type=radio]), :checked, fieldset:not(:has(:checked)) input';

/**
 * @param want called when the focus comes to it, or a press
 * @returns function that takes it away once the figure is built, and hands the focus on to the figure's controls
 */
export function standIn(figure: HTMLElement, label: string, want: () => void): () => void {
	const button = document.createElement('button');
	button.type = 'button';
	button.className = 'stand-in';
	button.textContent = label;
	let backwards = false;
	button.addEventListener('focus', ({ relatedTarget: from }) => {
		const place = from instanceof Node ? button.compareDocumentPosition(from) : 0;
		backwards = Boolean(place & Node.DOCUMENT_POSITION_FOLLOWING);
		want();
	});
	button.addEventListener('click', want);
	figure.prepend(button);
	return () => {
		const isFocused = document.activeElement === button;
		const live = figure.querySelector<HTMLElement>('.live, .words');
		const stops = [...(live?.querySelectorAll<HTMLElement | SVGElement>(STOPS) ?? [])];
		const stop = stops.filter((element) => element.checkVisibility()).at(backwards ? -1 : 0);
		// A figure that has failed has words alone.
		if (isFocused && live && !stop) live.tabIndex = -1;
		if (isFocused) (stop ?? live)?.focus();
		button.remove();
	};
}
