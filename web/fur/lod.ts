/** How many shells a picture needs, and what is cut off them. */

import type { Camera } from 'three';

/** Coverage below which a fragment is dropped where texels are no smaller than pixels. */
export const ALPHA_CUT = 0.1;

/** What is left of the cut where many texels share a pixel: thin hairs have become a haze there, and not less. */
const FAR_CUT = 0.2;

/** Pixels between two shells: beyond, hairs turn into strings of beads. */
const SPACING = 1.5;

/**
 * The number of shells that shows fur as if there were many more; it grows steadily, not in steps.
 *
 * @param pixels how long the longest hairs are on the screen where they are nearest
 * @param least with fewer than slabs some slabs are left out, and fur changes its colour a little
 */
export function shellsFor(pixels: number, least: number): number {
	return Math.max(pixels / SPACING, least);
}

/** Coverage below which a fragment is dropped. @param pixels that a texel is wide on the screen */
export function cutFor(pixels: number): number {
	return ALPHA_CUT * Math.min(Math.max((0.8 * pixels) ** 1.7, FAR_CUT), 1);
}

/**
 * Pixels that a unit of the world is long on the screen.
 *
 * @param height of the picture, pixels
 * @param distance from the camera, world units
 */
export function pixelsPerUnit(camera: Camera, height: number, distance: number): number {
	const { elements } = camera.projectionMatrix;
	return (0.5 * height * (elements[5] as number)) / ((elements[11] as number) < 0 ? distance : 1);
}
