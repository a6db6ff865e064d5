/** Forces on the fur during one sub-step, in the axes of the shells' mesh. */

/** Number of waves in the wind's gusts. */
export const WAVES = 4;

/**
 * Forces common to all follicles. `CpuSprings` and springs.frag.glsl apply them and have to agree.
 */
export interface Drive {
	/** Displacement of the longest tips by gravity alone, shares of the length. */
	readonly sag: Float32Array;
	/** Displacement of the longest tips by a wind along the skin alone, share of the length. */
	gale: number;
	/** Unit vector along the wind. */
	readonly blow: Float32Array;
	/** Strength of the gusts, 0..1. */
	gusts: number;
	/** Waves: XYZ = turns per unit of the mesh, W = phase in turns. */
	readonly waves: Float32Array;
	/** Rows of the matrix (position, 1) → velocity added to the tips by the skin's motion, 1/s. */
	readonly kick: Float32Array;
	/** Whether `kick` is not zero. */
	kicks: boolean;
	/** Factor of the offsets left by strokes. */
	fade: number;
}

/** Drive without forces. */
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

/** Shares of the first waves in the gusts' strength. */
export const STRENGTHS = [0.5, 0.3, 0.2] as const;
/** Largest change of the wind by gusts, share of its strength. */
export const GUST = 0.65;
/** Largest sideways part of the wind in gusts, share of its strength. */
export const VEER = 0.35;
/** Part of the wind missing in the body's lee, share of its strength. */
export const LEE = 0.75;
