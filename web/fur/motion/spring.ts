/** A damped spring, and the numbers that solvers on CPU and GPU have in common. */

/** Seconds of a sub-step. Fixed, so that what hairs give to their neighbours does not depend on the frame rate. */
export const STEP = 1 / 30;

/** The farthest that a tip lies from its root along the skin, share of the hair's length. */
export const LIMIT = 0.8;

/** No tip is faster, in ω: what it may swing through when it is thrown, several times over. */
const FASTEST = 4;

/** How a spring goes on by one step: x' = xₑ + xx·(x − xₑ) + xv·v, v' = vx·(x − xₑ) + vv·v. */
export interface Spring {
	/** ω, 1/s. */
	readonly pace: number;
	/** Share of the displacement that stays. */
	readonly xx: number;
	/** Seconds. */
	readonly xv: number;
	/** 1/s. */
	readonly vx: number;
	/** Share of the velocity that stays. */
	readonly vv: number;
	/** Velocities beyond are cut, 1/s. */
	readonly fastest: number;
	/** What is left of a swing at most: e^(−ζω·seconds). */
	readonly decay: number;
	/** An upper bound of all swings, in the norm that `decay` holds for. */
	readonly widest: number;
}

/**
 * The exact solution of x″ = −ω²(x − xₑ) − 2ζω·x′ over a step in which xₑ stands still: stable for every ω, and as right
 * however long the step is.
 *
 * @param frequency of the undamped spring, Hz
 * @param damping ζ, share of the critical one, below 1
 * @param seconds of the step; a sub-step of `FurMotion` by default
 */
export function springOf(frequency: number, damping: number, seconds = STEP): Spring {
	const pace = 2 * Math.PI * frequency;
	const a = damping * pace;
	const swing = pace * Math.sqrt(1 - damping ** 2);
	const decay = Math.exp(-a * seconds);
	const [cos, sin] = [decay * Math.cos(swing * seconds), (decay * Math.sin(swing * seconds)) / swing];
	return {
		pace,
		xx: cos + a * sin,
		xv: sin,
		vx: -(pace ** 2) * sin,
		vv: cos - a * sin,
		fastest: FASTEST * pace,
		decay,
		widest: Math.sqrt(((1 + damping) / (1 - damping)) * ((2 * LIMIT) ** 2 + FASTEST ** 2)),
	};
}
