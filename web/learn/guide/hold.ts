/** Button that holds still what moves by itself: the lamp that drifts until it is taken, and the wind. */

import type { Calm } from '../calm.ts';
import { action } from '../controls.ts';

/** Adds the button below a figure; none where the page is always calm. */
export function holdButton(figure: HTMLElement, label: string, calm: Calm): void {
	if (calm.always) return;
	const button = action(figure, label, () => {
		calm.on = !calm.on;
	});
	button.classList.add('hold');
	// The caption stays the last.
	figure.querySelector('figcaption')?.before(button);
	calm.listen((on) => button.setAttribute('aria-pressed', String(on)));
}
