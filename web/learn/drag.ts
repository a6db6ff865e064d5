/** Input on a figure's canvas: drags and arrow keys move the light; vertical strokes of a finger scroll the page. */

import { type Camera, MathUtils, Object3D, Vector2, Vector3 } from 'three';
import { directionUnder } from '../page/aim.ts';
import type { SharedLight } from './light.ts';

const STEP = MathUtils.degToRad(5); // per arrow key

const ARROWS: Record<string, [right: number, up: number]> = {
	ArrowLeft: [-1, 0],
	ArrowRight: [1, 0],
	ArrowUp: [0, 1],
	ArrowDown: [0, -1],
};

/** Calls back for arrow keys while `target` is focused. */
export function arrows(target: GlobalEventHandlers, step: (right: number, up: number) => void): void {
	target.addEventListener('keydown', (event: KeyboardEvent) => {
		const arrow = ARROWS[event.key];
		if (!arrow || event.ctrlKey || event.metaKey || event.altKey) return;
		event.preventDefault();
		step(...arrow);
	});
}

/** Lets arrow keys move the light while `target` is focused. */
export function lightByKeys(target: HTMLElement, light: SharedLight): void {
	arrows(target, (right, up) => light.turn(right * STEP, up * STEP));
}

/**
 * Calls `move` with the place on the canvas, in normalised device coordinates (-1..1, y up), of a dragging mouse, pen or
 * finger, and `end` on release. The style sheet leaves vertical strokes of a finger to the page: `touch-action: pan-y`.
 */
export function listenToDrags(
	canvas: HTMLCanvasElement,
	move: (pointer: Vector2) => void,
	end: () => void = () => {},
): void {
	const pointer = new Vector2();
	let dragging: number | undefined;
	let touched: { id: number; x: number; y: number } | undefined;
	const follow = ({ clientX, clientY }: PointerEvent) => {
		const { left, top, width, height } = canvas.getBoundingClientRect();
		move(pointer.set(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2));
	};
	canvas.addEventListener('pointerdown', (event) => {
		if (event.button !== 0) return;
		if (event.pointerType === 'touch') {
			touched = { id: event.pointerId, x: event.clientX, y: event.clientY };
			return;
		}
		canvas.setPointerCapture(event.pointerId);
		dragging = event.pointerId;
		follow(event);
	});
	canvas.addEventListener('pointermove', (event) => {
		const { pointerId: id, clientX: x, clientY: y } = event;
		if (id === touched?.id && Math.abs(x - touched.x) > Math.abs(y - touched.y)) dragging = id;
		if (id === dragging) follow(event);
	});
	canvas.addEventListener('pointerup', (event) => {
		// A tap is a drag of length 0.
		if (event.pointerId !== touched?.id || dragging !== undefined) return;
		follow(event);
		end();
	});
	for (const name of ['pointerup', 'pointercancel', 'lostpointercapture'] as const)
		canvas.addEventListener(name, ({ pointerId }) => {
			if (pointerId === touched?.id) touched = undefined;
			if (pointerId !== dragging) return;
			dragging = undefined;
			end();
		});
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
