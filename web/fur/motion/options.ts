import type { WebGLRenderer } from 'three';

/** What a FurMotion may be told. */
export interface MotionOptions {
	/** How fast the fur swings to and fro, Hz; 0.2 to 20, 2.4 by default. */
	frequency?: number;
	/** How soon it is still: ζ, share of the critical damping; 0.05 to 0.95, 0.28 by default. */
	damping?: number;
	/** How much hairs take their neighbours along, 0 (not at all) to 1; 0.3 by default. */
	coupling?: number;
	/** Seconds in which a stroked lane loses all but 1/e, 0.01 to 3600; 1.2 by default. */
	relaxation?: number;
	/** Gravities: 1, the default, is what the fur was baked under. */
	gravity?: number;
	/** Of the wind's gusts: other ones for another seed. */
	seed?: number;
	/** Whose GPU takes over what is too much for the CPU; without it nothing does. */
	renderer?: WebGLRenderer;
	/** Milliseconds by which the time of CPU and GPU is taken. */
	clock?: () => number;
}

const RANGES = {
	frequency: [0.2, 20],
	damping: [0.05, 0.95],
	coupling: [0, 1],
	relaxation: [0.01, 3600],
} as const;

/** Options with their defaults in place. */
export function completed({
	frequency = 2.4,
	damping = 0.28,
	coupling = 0.3,
	relaxation = 1.2,
	gravity = 1,
	seed = 1,
	clock = () => performance.now(),
}: MotionOptions) {
	const numbers = { frequency, damping, coupling, relaxation };
	for (const name of Object.keys(RANGES) as (keyof typeof RANGES)[]) {
		const [least, most] = RANGES[name];
		const value = numbers[name];
		if (!(value >= least && value <= most))
			throw new Error(`FurMotion/${name}: got ${value}, expected ${least} to ${most}`);
	}
	return { ...numbers, gravity, seed, clock };
}
