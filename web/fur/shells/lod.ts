/** Number of shells, alpha cut and crispness for a picture. */

import type { Camera } from 'three';
import type { Contrast } from '../planes/crisp.ts';

/** Coverage below which a fragment is dropped where texels are no smaller than pixels. */
export const ALPHA_CUT = 0.1;

/** Share of the cut left where many texels share a pixel: thin hairs are a haze there, not gone. */
const FAR_CUT = 0.2;

/** Largest distance between two shells, pixels: beyond, hairs look like strings of beads. */
export const SPACING = 1.5;

/**
 * Number of shells beyond which the picture hardly changes; continuous, without steps.
 *
 * @param pixels largest length of a hair on screen
 * @param least smallest result; below the number of slabs some are left out, and fur changes its colour a little
 */
export function shellsFor(pixels: number, least: number): number {
	return Math.max(pixels / SPACING, least);
}

/** Coverage below which a fragment is dropped. @param pixels width of a texel on screen */
export function cutFor(pixels: number): number {
	return ALPHA_CUT * Math.min(Math.max((0.8 * pixels) ** 1.7, FAR_CUT), 1);
}

/** Width of texels on screen, pixels, from which on hairs get crisp, and how much for each pixel more. */
const CRISP_FROM = 0.3;
const CRISP_PER_PIXEL = 1.5;

/** Largest crispness: beyond, the texels' corners show. */
const CRISPEST = 2.5;

/**
 * Contrast of coverage on screen over the texels'.
 *
 * @param pixels width of a texel on screen
 */
export function crispnessFor(pixels: number): number {
	return Math.min(Math.max(1 + CRISP_PER_PIXEL * (pixels - CRISP_FROM), 1), CRISPEST);
}

/** Contrast and cut of near texels, and of those that the next level stands in for: see `crispLevels`. */
export const CONTRASTS = [contrastFor(2), contrastFor(0.5)] as const;

/** @param pixels width of a texel on screen */
function contrastFor(pixels: number): Contrast {
	return { contrast: crispnessFor(pixels), cut: cutFor(pixels) };
}

/**
 * Texels are read this much finer than one a pixel, levels: blended they are as wide as two, and hairs lose a third of
 * their contrast.
 */
export const LOD_BIAS = -0.4;

/** Share of texels of the second level in a picture, 0..1. @param pixels width of a texel of the first on screen */
export function coarserShare(pixels: number): number {
	return Math.min(Math.max(LOD_BIAS - Math.log2(pixels), 0), 1);
}

/**
 * Length of a world unit on screen, pixels.
 *
 * @param height of the picture, pixels
 * @param distance from the camera, world units
 */
export function pixelsPerUnit(camera: Camera, height: number, distance: number): number {
	const { elements } = camera.projectionMatrix;
	return (0.5 * height * (elements[5] as number)) / ((elements[11] as number) < 0 ? distance : 1);
}
