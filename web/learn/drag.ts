/** Input on a figure's canvas: drags and arrow keys move the light; vertical strokes of a finger scroll the page. */

import { type Camera, MathUtils, Object3D, Vector3 } from 'three';
import { directionUnder } from '../page/aim.ts';
import { arrows, listenToDrags } from '../scene/drag.ts';
import type { SharedLight } from './light.ts';

const STEP = MathUtils.degToRad(5); // per arrow key

/** Steps of an arrow key in one of Page Up and Page Down. */
const PAGE = 5;

/** Value that a handle of role `slider` sets. */
export interface Handle {
	least: number;
	most: () => number;
	/** Change by an arrow key. */
	step: () => number;
	value: () => number;
	put: (value: number) => void;
}

/** Lets keys move a handle as they move a slider: arrows, Page Up, Page Down, Home, End. */
export function slideByKeys(target: GlobalEventHandlers, { least, most, step, value, put }: Handle): void {
	const bounded = (to: number) => put(Math.min(Math.max(to, least), most()));
	arrows(target, (right, up) => bounded(value() + (right + up) * step()));
	const jumps: Record<string, () => number> = {
		PageUp: () => value() + PAGE * step(),
		PageDown: () => value() - PAGE * step(),
		Home: () => least,
		End: most,
	};
	target.addEventListener('keydown', (event: KeyboardEvent) => {
		const jump = jumps[event.key];
		if (!jump || event.ctrlKey || event.metaKey || event.altKey) return;
		event.preventDefault();
		bounded(jump());
	});
}

/** Lets a canvas take arrow keys: it can be focused, and is an application, whose keys screen readers hand on. */
export function takeKeys(canvas: HTMLCanvasElement, step: (right: number, up: number) => void): void {
	canvas.tabIndex = 0;
	canvas.setAttribute('role', 'application');
	arrows(canvas, step);
}

/** Lets arrow keys move the light while a canvas is focused. */
export function lightByKeys(canvas: HTMLCanvasElement, light: SharedLight): void {
	takeKeys(canvas, (right, up) => light.turn(right * STEP, up * STEP));
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
