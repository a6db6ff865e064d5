/** What both solvers make of follicles before anything moves. */

import type { Follicles } from '../follicles.ts';
import { LIMIT } from './spring.ts';

/** Follicles as solvers have them. */
export interface Roots {
	readonly follicles: Follicles;
	/** The follicles' comb in the very tangent plane, no longer than the limit; so the rest is inside of what is allowed. */
	readonly comb: Float32Array;
	/** Of each link, what a follicle takes over of its neighbour's difference in a sub-step. */
	readonly weights: Float32Array;
}

/**
 * The links' weights are the same from both ends, and of a follicle's their sum is less than `coupling` / 2 (Metropolis's
 * weights, by the number of neighbours that the more popular end has).
 *
 * @param coupling 0..1
 */
export function rootsOf(follicles: Follicles, coupling: number): Roots {
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
	return { follicles, comb, weights };
}
