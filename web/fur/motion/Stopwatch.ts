/** Frames judged together, by their median: single hiccups don't count. */
const FRAMES = 15;

/** Watch on work that may take longer than its budget, frame after frame. */
export class Stopwatch {
	readonly #clock: () => number;
	readonly #budget: number;
	readonly #times = new Float64Array(FRAMES);
	#count = 0;
	#started = 0;

	/**
	 * @param budget time per frame, milliseconds
	 * @param clock present time, milliseconds
	 */
	constructor(budget: number, clock: () => number) {
		this.#budget = budget;
		this.#clock = clock;
	}

	/** Starts a frame's work. */
	start(): void {
		this.#started = this.#clock();
	}

	/** Ends a frame's work. @returns median milliseconds if over the budget, once per many frames; else 0 */
	stop(): number {
		this.#times[this.#count++] = this.lap();
		if (this.#count < FRAMES) return 0;
		this.#count = 0;
		this.#times.sort();
		const median = this.#times[FRAMES >> 1] as number;
		return median > this.#budget ? median : 0;
	}

	/** Milliseconds since the start. */
	lap(): number {
		return this.#clock() - this.#started;
	}
}
