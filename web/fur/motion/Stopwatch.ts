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

	/** It has ended. @returns whether it takes too long, told once for many frames */
	stop(): boolean {
		this.#times[this.#count++] = this.#clock() - this.#started;
		if (this.#count < FRAMES) return false;
		this.#count = 0;
		this.#times.sort();
		return (this.#times[FRAMES >> 1] as number) > this.#budget;
	}
}
