/** What moves the fur during one sub-step, in the axes of the shells' mesh. */

/** Waves that the wind's gusts are made of. */
export const WAVES = 4;

/**
 * The same for all follicles. What one of them makes of it stands in two places that have to agree: `CpuSprings` and
 * springs.frag.glsl.
 */
export interface Drive {
	/** Where gravity alone takes the tips of the longest fur, shares of the length. */
	readonly sag: Float32Array;
	/** Where the wind alone takes the tips of the longest fur that it blows along, share of the length. */
	gale: number;
	/** Unit vector along the wind. */
	readonly blow: Float32Array;
	/** How far gusts go, 0..1. */
	gusts: number;
	/** A wave each: XYZ = turns per unit of the mesh, W = turns. */
	readonly waves: Float32Array;
	/** Rows of the matrix that takes (position, 1) to the velocity that the skin's own gives to the tips, 1/s. */
	readonly kick: Float32Array;
	/** Whether there is any. */
	kicks: boolean;
	/** What the offsets left by strokes are multiplied by. */
	fade: number;
}

/** One that moves nothing. */
export function calm(): Drive {
	return {
		sag: new Float32Array(3),
		gale: 0,
		blow: new Float32Array(3),
		gusts: 0,
		waves: new Float32Array(4 * WAVES),
		kick: new Float32Array(12),
		kicks: false,
		fade: 1,
	};
}

/** How much the first waves strengthen the wind, of what gusts do. */
export const STRENGTHS = [0.5, 0.3, 0.2] as const;
/** How much gusts strengthen or weaken the wind at most, share of it. */
export const GUST = 0.65;
/** How far gusts turn it at most, share of it to the side. */
export const VEER = 0.35;
/** What is missing of it on the body's far side, share of it. */
export const LEE = 0.75;
