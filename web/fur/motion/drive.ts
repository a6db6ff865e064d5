/** Forces on the fur during one sub-step. */

import { FOLLICLES_PER_ROW } from '../body/FurFollicles.ts';

/** Number of waves in the wind's gusts. */
export const WAVES = 4;
/** Numbers per joint. */
export const JOINT = 24;

/**
 * Forces common to all follicles, and motion of their joints. `CpuSprings` and springs.frag.glsl apply them and have to agree.
 */
export interface Drive {
	/** Displacement of the longest tips by gravity alone, shares of the length; world axes. */
	readonly pull: Float32Array;
	/** That of the baked pose, which is in the comb; the mesh's axes. */
	readonly laid: Float32Array;
	/** Whether the two differ. */
	sags: boolean;
	/** Displacement of the longest tips by a wind along the skin alone, share of the length. */
	gale: number;
	/** Unit vector along the wind, world axes. */
	readonly blow: Float32Array;
	/** Strength of the gusts, 0..1. */
	gusts: number;
	/** Waves: XYZ = turns per radius of the body, world axes; W = phase at its centre in turns. */
	readonly waves: Float32Array;
	/**
	 * `JOINT` numbers each, then padding to whole rows of a texture. Rows of the matrix (position, 1) → place, in radii about the
	 * body's centre, and of that to the velocity added to the tips by the skin's motion, 1/s; the mesh's axes → the world's.
	 */
	readonly joints: Float32Array;
	/** Whether any velocity is added. */
	kicks: boolean;
	/** Velocity added to the tips by morph targets, 1/s, the mesh's axes; an RGBA texel for each follicle. */
	readonly ways: Float32Array;
	/** Whether that is not zero. */
	morphs: boolean;
	/** Factor of the offsets left by strokes. */
	fade: number;
}

/** Drive without forces. @param follicles how many morph targets move, if any do */
export function calm(joints = 1, follicles = 0): Drive {
	const row = 4 * FOLLICLES_PER_ROW;
	const drive = {
		pull: new Float32Array(3),
		laid: new Float32Array(3),
		sags: false,
		gale: 0,
		blow: new Float32Array(3),
		gusts: 0,
		waves: new Float32Array(4 * WAVES),
		// A row at least: of a body whose weights are all 0 no joint carries anything.
		joints: new Float32Array(row * Math.max(Math.ceil((JOINT * joints) / row), 1)),
		kicks: false,
		ways: new Float32Array(row * Math.ceil((4 * follicles) / row)),
		morphs: false,
		fade: 1,
	};
	for (let joint = 0; joint < joints; joint++)
		for (let axis = 0; axis < 3; axis++) drive.joints[JOINT * joint + 5 * axis] = 1;
	return drive;
}

/** Shares of the first waves in the gusts' strength. */
export const STRENGTHS = [0.5, 0.3, 0.2] as const;
/** Largest change of the wind by gusts, share of its strength. */
export const GUST = 0.65;
/** Largest sideways part of the wind in gusts, share of its strength. */
export const VEER = 0.35;
/** Part of the wind missing in the body's lee, share of its strength. */
export const LEE = 0.75;
