/** Dynamic resolution: as many pixels as a frame's time allows, all of them where nothing moves. */

/** Resolution per side, each step with √½ of the pixels of the one before. */
const STEPS = [1, 2 ** -0.25, 2 ** -0.5, 2 ** -0.75, 0.5] as const;

/** Frames that are judged together, by their median: single hiccups and the gap of a hidden tab don't count. */
const WINDOW = 9;
/** Frames right after a change that don't count: they, or the timer's late results, belong to the resolution before. */
const SETTLE = 4;
/** Shares of the target: above the first a window is late (two in a row step down), above the second one is enough. */
const LATE = 1.15;
const FAR_LATE = 1.5;
/** Share of the target that a step may fill by what the pixels let expect. */
const ROOM = 0.9;
/** Windows in a row that must have room before a step up. */
const CALM = 6;
/** Milliseconds from any change to a step up; four times as many after each one that was late within RASH milliseconds. */
const WAIT = 1000;
const RASH = 20_000;
const LONGEST_WAIT = 64_000;
/**
 * Where fewer pixels don't help, all are drawn, and for HOPELESS_WAIT milliseconds nothing is tried. They help where the
 * lowest resolution takes less than WORTH of the full one's time, which was measured at most DESCENT windows before.
 */
const WORTH = 0.9;
const DESCENT = 4;
const HOPELESS_WAIT = 30_000;

/** What a FurGovernor goes by. */
export interface GovernorOptions {
	/** Milliseconds that a frame may take. */
	target?: number;
	/**
	 * Whether times are intervals between frames, which the display's refresh keeps from falling: whether a higher
	 * resolution has room cannot be seen in them, so it is tried now and then. Otherwise they are times of the GPU.
	 */
	capped?: boolean;
	/** Milliseconds between two changes of the resolution, at least. */
	cooldown?: number;
	/** Milliseconds without movement after which the picture is drawn at full resolution. */
	rest?: number;
}

/**
 * Holds a frame rate by the resolution: fur seen from close by is overdraw, which costs by the pixel.
 *
 *     // each frame
 *     renderer.setPixelRatio(devicePixelRatio * governor.frame(milliseconds, now, moving)); // where it has changed
 *
 * It steps down when frames are late, as far as the time lets expect, and up again when there is room. It never swings:
 * times around the target change nothing, and tries that fail become rare.
 */
export class FurGovernor {
	readonly #target: number;
	readonly #capped: boolean;
	readonly #cooldown: number;
	readonly #rest: number;
	readonly #times = new Float64Array(WINDOW);
	#count = 0;
	#skip = SETTLE;
	#level = 0;
	#resting = false;
	#moved = Number.NEGATIVE_INFINITY;
	#changed = Number.NEGATIVE_INFINITY;
	#raised = Number.NEGATIVE_INFINITY;
	#raisedFrom = 0;
	#wait = WAIT;
	#heldUntil = Number.NEGATIVE_INFINITY;
	/** Windows in a row that were late, or had room. */
	#late = 0;
	#calm = 0;
	/** Time at full resolution when it was left, and windows since. */
	#full = 0;
	#since = 0;

	constructor({ target = 1000 / 60, capped = false, cooldown = 400, rest = 500 }: GovernorOptions = {}) {
		this.#target = target;
		this.#capped = capped;
		this.#cooldown = cooldown;
		this.#rest = rest;
	}

	/** What the resolution is multiplied by, per side: 1, 0.84, 0.71, 0.59 or 0.5. */
	get scale(): number {
		return this.#resting ? 1 : (STEPS[this.#level] ?? 1);
	}

	/**
	 * Once per frame, before it is drawn.
	 *
	 * @param time milliseconds of a frame before; NaN where none is known
	 * @param now milliseconds
	 * @param moving whether this frame differs from the one before
	 * @returns the scale to draw it at
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
		this.#skip = SETTLE;
		this.#late = 0;
		this.#calm = 0;
	}

	#measure(time: number, now: number): void {
		if (this.#skip > 0) {
			this.#skip--;
			return;
		}
		this.#times[this.#count++] = time;
		if (this.#count < WINDOW && !(this.#count === 3 && this.#allFarLate())) return;
		const median = this.#median();
		this.#count = 0;
		this.#since++;
		if (this.#resting) this.#learn(median);
		else if (median > LATE * this.#target) this.#beLate(median, now);
		else this.#beOnTime(median, now);
	}

	/** Whether three frames in a row are so late that there is no need to wait for more. */
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
		if (this.#level === STEPS.length - 1) {
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
		// Intervals come in multiples of the display's: what was in time before is the better guess.
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

	/** The highest resolution that is on time if the time goes with the pixels. */
	#fitting(median: number): number {
		const own = STEPS[this.#level] ?? 1;
		for (let level = 0; level < STEPS.length; level++)
			if (median * ((STEPS[level] ?? 1) / own) ** 2 <= ROOM * this.#target) return level;
		return STEPS.length - 1;
	}

	/** What stands still is drawn at full resolution: if that is in time, so it will be in motion. */
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
