/** Common hue of a scene's lamps, if any: fur then sums strengths instead of colours. */

import { Color, type DirectionalLight, type Object3D, type ShaderMaterial } from 'three';
import { luminance } from '../light/furEnvironment.ts';
import { switchPart } from './switches.ts';

/** Largest difference per channel between equal hues of luminance 1. */
const SAME = 1e-4;

const hue = new Color();
const first = new Color();
let found = false;
let shared = true;

/** Called for every object, so free of allocation. */
function visit(object: Object3D): void {
	const { color, intensity, isDirectionalLight, isPointLight, isSpotLight } = object as DirectionalLight & Lamps;
	if (!(isDirectionalLight || isPointLight || isSpotLight) || intensity === 0) return;
	const bright = luminance(color);
	if (bright === 0) return;
	hue.copy(color).multiplyScalar(1 / bright);
	if (!found) first.copy(hue);
	found = true;
	const apart = Math.max(Math.abs(hue.r - first.r), Math.abs(hue.g - first.g), Math.abs(hue.b - first.b));
	shared &&= apart <= SAME * Math.max(hue.r, hue.g, hue.b);
}

/**
 * Common colour, of luminance 1, of all directional, point and spot lights below an object; white where none shines.
 *
 * @param target takes it
 * @returns whether they share one
 */
export function sharedHue(scene: Object3D, target: Color): boolean {
	found = false;
	shared = true;
	first.setRGB(1, 1, 1);
	scene.traverseVisible(visit);
	target.copy(first);
	return shared;
}

interface Lamps {
	isPointLight?: boolean;
	isSpotLight?: boolean;
}

/** Adapt a material of fur to the hue of a scene's lamps. Call it before each draw. */
export function followHue(material: ShaderMaterial, scene: Object3D): void {
	const { lampHue } = material.uniforms;
	if (lampHue) switchPart(material, 'ONE_HUE', sharedHue(scene, lampHue.value) ? '' : undefined);
}
