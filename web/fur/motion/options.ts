import type { WebGLRenderer } from 'three';

/** Options of FurMotion. */
export interface FurMotionOptions {
	/** Frequency of the undamped swing, Hz; 0.2 to 20, 2.4 by default. */
	frequency?: number;
	/** Damping ζ, share of the critical one; 0.05 to 0.95, 0.28 by default. */
	damping?: number;
	/** Coupling of hairs with their neighbours, 0 to 1; 0.3 by default. */
	coupling?: number;
	/** Seconds until 1/e of a stroked lane is left, 0.01 to 3600; 1.2 by default. */
	relaxation?: number;
	/** Gravity over the baked one; 1 by default. */
	gravity?: number;
	/** Seed of the wind's gusts. */
	seed?: number;
	/** Renderer whose GPU takes over when the CPU is too slow; without one the CPU goes on. */
	renderer?: WebGLRenderer;
	/** Clock for the comparison of CPU and GPU, milliseconds. */
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
}: FurMotionOptions) {
	const numbers = { frequency, damping, coupling, relaxation };
	for (const name of Object.keys(RANGES) as (keyof typeof RANGES)[]) {
		const [least, most] = RANGES[name];
		const value = numbers[name];
		if (!(value >= least && value <= most))
			throw new Error(`FurMotion/${name}: got ${value}, expected ${least} to ${most}`);
	}
	return { ...numbers, gravity, seed, clock };
}
