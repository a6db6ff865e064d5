/** Follicles prepared for both solvers. */

import type { FurFollicles } from '../body/FurFollicles.ts';
import { type Joints, jointsOf } from '../body/joints/joints.ts';
import { LIMIT } from './spring.ts';

/** Follicles with their joints, comb and coupling weights. */
export interface Roots {
	readonly follicles: FurFollicles;
	readonly joints: Joints;
	/** Comb projected to the tangent plane and clamped to the limit, so that the rest is within it. */
	readonly comb: Float32Array;
	/** Weight of each link: share of the neighbour's difference taken over in a sub-step. */
	readonly weights: Float32Array;
}

/**
 * Prepares follicles. Weights of links are equal from both ends and sum to less than `coupling` / 2 per follicle: Metropolis
 * weights, by the larger number of neighbours of the two ends.
 *
 * @param coupling 0..1
 */
export function rootsOf(follicles: FurFollicles, coupling: number): Roots {
	const { count, normal, first, links } = follicles;
	const comb = follicles.comb.slice();
	const weights = new Float32Array(links.length);
	const degree = (i: number) => (first[i + 1] as number) - (first[i] as number);
	for (let i = 0; i < count; i++) {
		const [x, y, z] = [3 * i, 3 * i + 1, 3 * i + 2];
		const [nx, ny, nz] = [normal[x], normal[y], normal[z]] as [number, number, number];
		const out = (comb[x] as number) * nx + (comb[y] as number) * ny + (comb[z] as number) * nz;
		const flat = [(comb[x] as number) - out * nx, (comb[y] as number) - out * ny, (comb[z] as number) - out * nz];
		const long = Math.hypot(...flat);
		comb.set(long > LIMIT ? flat.map((c) => (c * LIMIT) / long) : flat, x);
		for (let link = first[i] as number; link < (first[i + 1] as number); link++)
			weights[link] = (0.5 * coupling) / (1 + Math.max(degree(i), degree(links[link] as number)));
	}
	return { follicles, joints: jointsOf(follicles), comb, weights };
}
