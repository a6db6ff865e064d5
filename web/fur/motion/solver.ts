/** Common interface of the springs on CPU and GPU. */

import type { Texture } from 'three';
import type { Drive } from './drive.ts';

/** Numbers per follicle's state: displacement and velocity. */
export const STATE = 6;

/** SpringStates of the follicles. */
export interface SpringStates {
	/** SpringStates at the beginning of the last sub-step, `STATE` numbers each. */
	readonly before: Float32Array;
	/** SpringStates at its end. */
	readonly after: Float32Array;
}

/** Solver of the hairs' swing. */
export interface Solver {
	/** Displacements for `Fur.swing`. */
	readonly swing: Texture;
	/** Advances by a sub-step. */
	step(drive: Drive): void;
	/** Writes `swing`. @param share elapsed share of the last sub-step */
	show(share: number): void;
	/** Resets all hairs to the baked pose. */
	rest(): void;
	/** Frees its GPU objects, `swing` included, which resets furs that use it. */
	dispose(): void;
}
