/** What the springs on CPU and GPU have in common. */

import type { Texture } from 'three';
import type { Drive } from './drive.ts';

/** Numbers of a follicle's state: displacement and velocity. */
export const STATE = 6;

/** Follicles' states, as one follows another. */
export interface States {
	/** At the beginning of the last sub-step, `STATE` numbers each. */
	readonly before: Float32Array;
	/** At its end. */
	readonly after: Float32Array;
}

/** Hairs that swing. */
export interface Solver {
	/** As `Fur.swing` takes it. */
	readonly swing: Texture;
	/** Goes on by a sub-step. */
	step(drive: Drive): void;
	/** Writes `swing`. @param share of the last sub-step that is over */
	show(share: number): void;
	/** All hairs as they were baked. */
	rest(): void;
	/** Frees what it has on the GPU; `swing`, too, which furs take for the end of it. */
	dispose(): void;
}
