/** Details of bodies by their size on screen. */

import type { Camera } from 'three';
import type { Fur } from '../Fur.ts';
import { tileOf } from '../format.ts';
import { coarserShare, crispnessFor, cutFor, pixelsPerUnit, shellsFor } from '../shells/lod.ts';

/** Number of shells, alpha cut, crispness and share of coarser texels of each body, as the fur by itself would have them. */
export class BodyDetails {
	/** Four numbers per body. */
	readonly values: Float32Array;
	/** Width of a texel of each body on screen, pixels. */
	readonly texels: Float32Array;
	readonly #fur: Fur;
	readonly #most: number;
	/** Length of the longest hairs, width of a texel and radius of the shells, in the body's axes. */
	#length = 0;
	readonly #texel: number;
	#radius = 0;

	/** @param most largest number of shells of a body */
	constructor(fur: Fur, capacity: number, most: number) {
		this.values = new Float32Array(4 * capacity);
		this.texels = new Float32Array(capacity);
		this.#fur = fur;
		this.#most = most;
		this.#texel = tileOf(fur.asset) / fur.asset.size;
	}

	/** Takes the fur's present length. @param radius of the shells, in the body's axes */
	fit(radius: number): void {
		this.#length = this.#fur.shells.furLength;
		this.#radius = radius;
	}

	/** Whether the fur has the length that it had at the last `fit`. */
	get fits(): boolean {
		return this.#length === this.#fur.shells.furLength;
	}

	/** Number of shells of a body; may be fractional. */
	shells(body: number): number {
		return this.values[4 * body] as number;
	}

	/**
	 * Writes the details of a body.
	 *
	 * @param unit world units per unit of the body
	 * @param away distance of its middle from the camera, world units
	 * @param fewest fewest shells
	 * @param height of the picture, pixels
	 */
	put(body: number, unit: number, away: number, fewest: number, camera: Camera, height: number): void {
		const { material, shells } = this.#fur;
		const { automatic, shellCount, coarseness } = shells;
		const near = Math.max(away - this.#radius * unit, 0.1 * away);
		const hair = this.#length * unit * pixelsPerUnit(camera, height, near);
		const wanted = automatic ? shellsFor(hair, fewest * material.trim) / coarseness : shellCount;
		const texel = this.#texel * unit * pixelsPerUnit(camera, height, away);
		this.texels[body] = texel;
		this.values[4 * body] = Math.min(Math.max(wanted, 1), this.#most);
		this.values[4 * body + 1] = cutFor(texel);
		this.values[4 * body + 2] = crispnessFor(texel);
		this.values[4 * body + 3] = coarserShare(texel);
	}
}
