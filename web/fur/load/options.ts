import type { Object3D } from 'three';
import type { FurLimits } from '../planes/furLimits.ts';

/** Options of FurLoaderPlugin. */
export interface FurLoaderOptions {
	/**
	 * Checks the file before it is shown; true by default. False for models that are known to be sound, as by `furbake
	 * validate`: the checks are then not fetched, and what a broken file does is not told.
	 */
	check?: boolean;
	/** Limits of the GPU, by `furLimits`: a larger asset is refused before its planes are decoded. */
	limits?: FurLimits;
	/** Anisotropy of the shells' planes, texels, 1 to 16 as far as the GPU allows; 2 by default. */
	anisotropy?: number;
	/**
	 * Most states of a pelt (dry, wet, dirty) on the GPU at a time; all by default. A pelt with more states, or more layers
	 * than a texture takes, keeps two: those around its furs' present wetness. Mud is then colour alone, without clumps.
	 */
	states?: number;
	/** Called for fur of a newer version than `FUR_VERSION`, of which only the skin is shown; a console warning by default. */
	newer?: (version: string) => void;
	/** Called with the loaded scene once its skin can be shown, in its own colours, before any plane has been fetched. */
	skin?: (scene: Object3D) => void;
}
