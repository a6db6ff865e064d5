/** Input on a figure's canvas: drags and arrow keys move the light; vertical strokes of a finger scroll the page. */

import { type Camera, MathUtils, Object3D, Vector3 } from 'three';
import { directionUnder } from '../page/aim.ts';
import { arrows, listenToDrags } from '../scene/drag.ts';
import type { SharedLight } from './light.ts';

const STEP = MathUtils.degToRad(5); // per arrow key

/** Lets arrow keys move the light while `target` is focused. */
export function lightByKeys(target: HTMLElement, light: SharedLight): void {
	arrows(target, (right, up) => light.turn(right * STEP, up * STEP));
}

/**
 * Lets drags put the lamp under the finger, on a sphere around `centre`, and arrow keys move it.
 *
 * @param turn turn of the lamp about the upright axis against other figures, radians
 */
export function lightByHand(
	canvas: HTMLCanvasElement,
	light: SharedLight,
	camera: Camera,
	centre: Vector3,
	radius: number,
	turn = 0,
): void {
	const wanted = new Vector3();
	listenToDrags(canvas, (pointer) => {
		directionUnder(pointer, camera, centre, radius, wanted).applyAxisAngle(Object3D.DEFAULT_UP, -turn);
		light.set(wanted.x, wanted.y, wanted.z);
	});
	lightByKeys(canvas, light);
}
