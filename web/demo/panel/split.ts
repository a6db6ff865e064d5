/** Line between two methods side by side: a handle for mouse, finger and keyboard, with their names. */

import { element } from '../../page/element.ts';
import { words } from '../words/index.ts';

const STEP = 0.02; // share of the room's width for an arrow key; with Shift five times as much
const EDGE = 0.02; // the handle stays within the room

/** Columns of the picture and shares of its room. */
interface Columns {
	/** share of the picture's width left of a share of the room's */
	columnOf(share: number): number;
	/** share of the room's width left of a point in the window */
	shareAt(x: number): number;
}

export class SplitLine {
	readonly #line = element('split');
	readonly #names = this.#line.querySelectorAll('span');
	readonly #columns: Columns;
	#share = 0.5;

	/**
	 * @param columns of the picture, as wide as the page
	 * @param moved called with the share of the room's width left of the line
	 */
	constructor(columns: Columns, moved: (share: number) => void) {
		this.#columns = columns;
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
			move(columns.shareAt(event.clientX));
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
		this.#line.setAttribute('aria-valuenow', String(percent));
		this.#line.setAttribute('aria-valuetext', `${percent} %`);
		this.place();
	}

	/** Places the line; call when the room has changed. */
	place(): void {
		this.#line.style.left = `${this.#columns.columnOf(this.#share) * 100}%`;
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
