/** Damped spring, and constants shared by the solvers on CPU and GPU. */

/** Length of a sub-step, seconds. Fixed, so that coupling does not depend on the frame rate. */
export const STEP = 1 / 30;

/** Largest displacement of a tip along the skin, share of the hair's length. */
export const LIMIT = 0.8;

/** Largest velocity of a tip, in ω: several times that of a thrown hair. */
const MAX_SPEED = 4;

/** One step of a spring: x' = xₑ + xx·(x − xₑ) + xv·v, v' = vx·(x − xₑ) + vv·v. */
export interface Spring {
	/** ω, 1/s. */
	readonly pace: number;
	/** Displacement by displacement. */
	readonly xx: number;
	/** Displacement by velocity, s. */
	readonly xv: number;
	/** Velocity by displacement, 1/s. */
	readonly vx: number;
	/** Velocity by velocity. */
	readonly vv: number;
	/** Largest velocity, 1/s. */
	readonly fastest: number;
	/** Upper bound of the rest of a swing after a step: e^(−ζω·seconds). */
	readonly decay: number;
	/** Upper bound of all swings, in the norm of `decay`. */
	readonly widest: number;
}

/**
 * The exact solution of x″ = −ω²(x − xₑ) − 2ζω·x′ over a step with constant xₑ: stable for every ω and exact for every
 * step.
 *
 * @param frequency of the undamped spring, Hz
 * @param damping ζ, share of the critical one, below 1
 * @param seconds length of the step; a sub-step of `FurMotion` by default
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
		fastest: MAX_SPEED * pace,
		decay,
		widest: Math.sqrt(((1 + damping) / (1 - damping)) * ((2 * LIMIT) ** 2 + MAX_SPEED ** 2)),
	};
}
