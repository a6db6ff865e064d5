/** Dynamic resolution: as many shells and pixels as a frame's time allows, all of them at rest. */

/** Resolution per side, each step with √½ of the pixels of the one before. */
const SCALES = [1, 2 ** -0.25, 2 ** -0.5, 2 ** -0.75, 0.5] as const;

/** Coarseness of shells that are a pixel apart; by itself they are 1.5 apart, and steep hairs look woven where pixels are large. */
const FINE = 2 / 3;

/** Shares of a frame's time that are left where shells are no longer fine, and where they are merged besides. */
const USUAL_TIME = 0.7;
const MERGED_TIME = 0.8 * USUAL_TIME;

/** How a frame is drawn. */
interface Step {
	scale: number;
	coarseness: number;
	merging: 0 | 1;
	/** Expected share of the time of the first step. */
	time: number;
}

const PIXELS: readonly Step[] = SCALES.map((scale) => ({ scale, coarseness: 1, merging: 0, time: scale * scale }));
const SHELLS_FIRST: readonly Step[] = [
	{ scale: 1, coarseness: FINE, merging: 0, time: 1 },
	{ scale: 1, coarseness: 1, merging: 0, time: USUAL_TIME },
	...PIXELS.map((step): Step => ({ ...step, merging: 1, time: MERGED_TIME * step.time })),
];

/** Milliseconds of a frame at rest up to which its shells are fine: a hand that moves on waits for it. */
const LONGEST_REST = 300;

/** Frames per window, judged by their median: single hiccups and the gap of a hidden tab don't count. */
const WINDOW = 9;
/** Frames to skip after a change: they, or late results of the timer, belong to the resolution before. A crawling one is two. */
const SKIPPED_FRAMES = 4;
/** Shares of the target: two windows in a row above the first step down, one above the second. */
const LATE = 1.15;
const FAR_LATE = 1.5;
/** Share of the target beyond which frames crawl: the first two that are not skipped decide. */
const CRAWLING = 24;
/** Share of the target that the time expected by the pixels may fill after a step. */
const ROOM = 0.9;
/** Windows in a row with room before a step up. */
const CALM = 6;
/** Milliseconds from any change to a step up; quadrupled by each step that was late within RASH milliseconds. */
const WAIT = 1000;
const RASH = 20_000;
const LONGEST_WAIT = 64_000;
/**
 * Fewer pixels help where the lowest resolution takes less than WORTH of the full one's time, measured at most DESCENT
 * windows before. Otherwise all are drawn, and nothing is tried for HOPELESS_WAIT milliseconds.
 */
const WORTH = 0.9;
const DESCENT = 4;
const HOPELESS_WAIT = 30_000;

/** Options of FurGovernor. */
export interface FurGovernorOptions {
	/** Target time of a frame, milliseconds. */
	target?: number;
	/**
	 * Whether times are intervals between frames, bounded below by the display's refresh, rather than times of the GPU. Such
	 * intervals don't show whether a higher resolution has room, so it is tried now and then.
	 */
	capped?: boolean;
	/** Whether there are fewer shells before there are fewer pixels; see `coarseness` and `merging`. */
	merges?: boolean;
	/** Smallest time between two changes of the resolution, milliseconds. */
	cooldown?: number;
	/** Milliseconds without movement after which the picture is drawn at full resolution. */
	rest?: number;
}

/**
 * Holds a frame rate by adapting the resolution: close-up fur is overdraw, which costs by the pixel.
 *
 *     // each frame
 *     renderer.setPixelRatio(devicePixelRatio * governor.frame(milliseconds, now, moving)); // where it has changed
 *
 * Steps down when frames are late, as far as their time suggests, and up again when there is room. It does not oscillate:
 * times around the target change nothing, and failed tries become rare.
 */
export class FurGovernor {
	readonly #steps: readonly Step[];
	readonly #target: number;
	readonly #capped: boolean;
	readonly #cooldown: number;
	readonly #rest: number;
	readonly #times = new Float64Array(WINDOW);
	#count = 0;
	#skip = SKIPPED_FRAMES;
	/** Whether all frames have crawled since the last change, or since motion or rest began. */
	#crawls = true;
	#level = 0;
	#resting = false;
	#moved = Number.NEGATIVE_INFINITY;
	#changed = Number.NEGATIVE_INFINITY;
	#raised = Number.NEGATIVE_INFINITY;
	#raisedFrom = 0;
	#wait = WAIT;
	#heldUntil = Number.NEGATIVE_INFINITY;
	/** Windows in a row that were late, and that had room. */
	#late = 0;
	#calm = 0;
	/** Time that a frame of the first step would take, by the last window in motion. */
	#whole = 0;
	/** Last time at full resolution, and windows since. */
	#full = 0;
	#since = 0;

	constructor(options: FurGovernorOptions = {}) {
		const { target = 1000 / 60, capped = false, merges = false, cooldown = 400, rest = 500 } = options;
		this.#steps = merges ? SHELLS_FIRST : PIXELS;
		this.#target = target;
		this.#capped = capped;
		this.#cooldown = cooldown;
		this.#rest = rest;
	}

	/** Factor of the resolution, per side: 1, 0.84, 0.71, 0.59 or 0.5. */
	get scale(): number {
		return this.#shown.scale;
	}

	/** Value for `FurShells.coarseness`: ⅔ where there is time, and at rest if that is no long frame, else 1; without `merges` 1. */
	get coarseness(): number {
		return this.#shown.coarseness;
	}

	/** Value for `FurShells.merging`: 1 from the second step down on if shells are merged first, else 0. */
	get merging(): 0 | 1 {
		return this.#shown.merging;
	}

	get #step(): Step {
		return this.#steps[this.#level] as Step;
	}

	get #shown(): Step {
		if (!this.#resting) return this.#step;
		const usual = this.#steps === SHELLS_FIRST && this.#whole > LONGEST_REST;
		return this.#steps[Number(usual)] as Step;
	}

	/**
	 * Takes a frame's time and picks the scale. Call it once per frame, before drawing.
	 *
	 * @param time milliseconds of an earlier frame; NaN if unknown
	 * @param now present time, milliseconds
	 * @param moving whether this frame differs from the one before
	 * @returns scale of the frame
	 */
	frame(time: number, now: number, moving: boolean): number {
		if (moving) this.#moved = now;
		const free = now - this.#changed >= this.#cooldown;
		const resting = now - this.#moved >= this.#rest;
		if (resting !== this.#resting && (free || this.#level === 0)) {
			this.#resting = resting;
			if (this.#level > 0) this.#changed = now;
			this.#restart();
		}
		if (free && now >= this.#heldUntil && resting === this.#resting && time > 0) this.#measure(time, now);
		return this.scale;
	}

	#restart(): void {
		this.#count = 0;
		this.#skip = SKIPPED_FRAMES;
		this.#crawls = true;
		this.#late = 0;
		this.#calm = 0;
	}

	#measure(time: number, now: number): void {
		this.#crawls &&= time > CRAWLING * this.#target;
		if (this.#skip > 0) {
			this.#skip -= this.#crawls ? 2 : 1;
			return;
		}
		this.#times[this.#count++] = time;
		const decided = (this.#count === 2 && this.#crawls) || (this.#count === 3 && this.#allFarLate());
		if (this.#count < WINDOW && !decided) return;
		const median = this.#median();
		this.#count = 0;
		this.#since++;
		if (!this.#resting) this.#whole = median / this.#step.time;
		if (this.#resting) this.#learn(median);
		else if (median > LATE * this.#target) this.#beLate(median, now);
		else this.#beOnTime(median, now);
	}

	/** Whether three frames in a row are late enough to decide at once. */
	#allFarLate(): boolean {
		for (let i = 0; i < this.#count; i++) if ((this.#times[i] ?? 0) <= FAR_LATE * this.#target) return false;
		return true;
	}

	/** Sorts the window in place. */
	#median(): number {
		const times = this.#times;
		for (let i = 1; i < this.#count; i++) {
			const time = times[i] ?? 0;
			let at = i;
			for (; at > 0 && (times[at - 1] ?? 0) > time; at--) times[at] = times[at - 1] ?? 0;
			times[at] = time;
		}
		return times[this.#count >> 1] ?? 0;
	}

	#beLate(median: number, now: number): void {
		this.#calm = 0;
		this.#late++;
		if (this.#late === 1 && median <= FAR_LATE * this.#target) return;
		const rash = now - this.#raised < RASH;
		if (this.#level === this.#steps.length - 1) {
			if (this.#since > DESCENT || median < WORTH * this.#full) return;
			this.#heldUntil = now + HOPELESS_WAIT;
			this.#change(0, now);
			return;
		}
		this.#wait = rash ? Math.min(this.#wait * 4, LONGEST_WAIT) : WAIT;
		if (this.#level === 0) {
			this.#full = median;
			this.#since = 0;
		}
		// Intervals are multiples of the display's: the last scale that was in time is the better guess.
		const level = rash && this.#capped ? this.#raisedFrom : this.#fitting(median);
		this.#change(Math.max(level, this.#level + 1), now);
	}

	#beOnTime(median: number, now: number): void {
		this.#late = 0;
		if (this.#level === 0) return;
		const fitting = this.#fitting(median);
		this.#calm = fitting < this.#level ? this.#calm + 1 : 0;
		const wait = this.#changed === this.#raised ? WAIT : this.#wait;
		if (now - this.#changed < wait) return;
		const level = this.#calm >= CALM ? fitting : this.#level - Number(this.#capped);
		if (level === this.#level) return;
		this.#raised = now;
		this.#raisedFrom = this.#level;
		this.#change(level, now);
	}

	/** First step expected in time, if time is proportional to pixels. */
	#fitting(median: number): number {
		const level = this.#steps.findIndex(({ time }) => (median * time) / this.#step.time <= ROOM * this.#target);
		return level < 0 ? this.#steps.length - 1 : level;
	}

	/** Learn from frames at rest: full resolution that is in time at rest is in time in motion. */
	#learn(median: number): void {
		this.#calm = median <= (this.#capped ? 1 : ROOM) * this.#target ? this.#calm + 1 : 0;
		if (this.#calm < CALM) return;
		this.#level = 0;
		this.#wait = WAIT;
	}

	#change(level: number, now: number): void {
		this.#level = level;
		this.#changed = now;
		this.#restart();
	}
}
