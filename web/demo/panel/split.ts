/** Line between two methods side by side: a handle for mouse, finger and keyboard, with their names. */

import { element } from '../../page/element.ts';
import { words } from '../words/index.ts';

const STEP = 0.02; // share of the width for an arrow key; with Shift five times as much
const EDGE = 0.02; // the handle stays within the window

export class SplitLine {
	readonly #line = element('split');
	readonly #names = this.#line.querySelectorAll('span');
	#share = 0.5;

	/**
	 * @param canvas of the picture, as wide as the page
	 * @param moved called with the share of its width left of the line
	 */
	constructor(canvas: HTMLElement, moved: (share: number) => void) {
		const line = this.#line;
		const move = (share: number) => {
			this.#setShare(share);
			moved(this.#share);
		};
		line.addEventListener('pointerdown', (event) => {
			if (event.button !== 0) return;
			line.setPointerCapture(event.pointerId);
			line.classList.add('held');
			event.preventDefault();
			line.focus({ preventScroll: true });
		});
		line.addEventListener('pointermove', (event) => {
			if (!line.hasPointerCapture(event.pointerId)) return;
			const { left, width } = canvas.getBoundingClientRect();
			move((event.clientX - left) / width);
		});
		line.addEventListener('lostpointercapture', () => line.classList.remove('held'));
		line.addEventListener('keydown', (event) => {
			const far = event.shiftKey ? 5 * STEP : STEP;
			const ways: Record<string, number> = {
				ArrowLeft: this.#share - far,
				ArrowDown: this.#share - far,
				ArrowRight: this.#share + far,
				ArrowUp: this.#share + far,
				Home: 0,
				End: 1,
			};
			const share = ways[event.key];
			if (share === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
			event.preventDefault();
			move(share);
		});
	}

	#setShare(share: number): void {
		this.#share = Math.min(Math.max(share, EDGE), 1 - EDGE);
		const percent = Math.round(this.#share * 100);
		this.#line.style.left = `${this.#share * 100}%`;
		this.#line.setAttribute('aria-valuenow', String(percent));
		this.#line.setAttribute('aria-valuetext', `${percent} %`);
	}

	/** @param right undefined: one method alone, and no line */
	show(left: string, right: string | undefined, share: number): void {
		this.#line.hidden = right === undefined;
		if (right === undefined) return;
		this.#line.setAttribute('aria-label', words.separator(left, right));
		[left, right].forEach((name, i) => {
			const place = this.#names[i];
			if (place) place.textContent = name;
		});
		this.#setShare(share);
	}
}
