/** Frames that are judged together, by their median: single hiccups don't count. */
const FRAMES = 15;

/** Tells whether some work takes longer than it may, frame after frame. */
export class Stopwatch {
	readonly #clock: () => number;
	readonly #budget: number;
	readonly #times = new Float64Array(FRAMES);
	#count = 0;
	#started = 0;

	/**
	 * @param budget of a frame, milliseconds
	 * @param clock milliseconds
	 */
	constructor(budget: number, clock: () => number) {
		this.#budget = budget;
		this.#clock = clock;
	}

	/** The work of a frame begins. */
	start(): void {
		this.#started = this.#clock();
	}

	/** It has ended. @returns milliseconds that it takes where that is too long, told once for many frames; else 0 */
	stop(): number {
		this.#times[this.#count++] = this.lap();
		if (this.#count < FRAMES) return 0;
		this.#count = 0;
		this.#times.sort();
		const median = this.#times[FRAMES >> 1] as number;
		return median > this.#budget ? median : 0;
	}

	/** Milliseconds since it was started. */
	lap(): number {
		return this.#clock() - this.#started;
	}
}
