/** Schedule of frames: one after the other while anything moves, few during slow changes, none at rest. */

export interface FrameHandlers {
	/** @returns whether a frame can be drawn now; else it is asked again before the next refresh of the display */
	ready(): boolean;
	/**
	 * Draws a frame.
	 *
	 * @param interval milliseconds since the frame before; NaN after a rest
	 * @param now milliseconds
	 * @returns milliseconds until the next frame is wanted: 0 at once, Infinity for none
	 */
	draw(interval: number, now: number): number;
	/** Called when no further frame comes by itself. */
	rest(): void;
}

export class Frames {
	readonly #handlers: FrameHandlers;
	/** Time of the frame before; NaN at rest. */
	#before = Number.NaN;
	#requested = false;
	#timer: ReturnType<typeof setTimeout> | undefined;
	/** Number of things that frames wait for. */
	#holds = 0;
	readonly #frame = (now: number) => {
		this.#requested = false;
		if (this.#holds > 0) return;
		if (!this.#handlers.ready()) return this.request();
		clearTimeout(this.#timer);
		const interval = now - this.#before;
		this.#before = now;
		const wait = this.#handlers.draw(interval, now);
		if (wait === 0) this.request();
		else if (Number.isFinite(wait)) this.#timer = setTimeout(() => this.request(), wait);
		else if (!this.#requested) {
			this.#before = Number.NaN;
			this.#handlers.rest();
		}
	};

	constructor(handlers: FrameHandlers) {
		this.#handlers = handlers;
		// The picture of a hidden tab may be gone.
		document.addEventListener('visibilitychange', () => this.request());
	}

	/** Draws no frame until this is done. */
	async hold(until: Promise<unknown>): Promise<void> {
		this.#holds++;
		this.#before = Number.NaN;
		try {
			await until;
		} finally {
			this.#holds--;
			this.request();
		}
	}

	/** Requests a frame; more follow while anything moves. */
	request(): void {
		if (this.#requested) return;
		this.#requested = true;
		requestAnimationFrame(this.#frame);
	}
}
