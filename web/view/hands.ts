/** Hands on a view: drags and arrow keys move the light; with Shift, the right button or the button for it, the camera. */

import { MathUtils, type Vector2, Vector3 } from 'three';
import { directionUnder } from '../page/aim.ts';
import { turned } from '../page/light.ts';
import { arrows, listenToDrags } from '../scene/drag.ts';
import type { FurPicture } from './FurPicture.ts';

/** Degrees per arrow key. */
const STEP = 4;
/** Factor of the distance per key. */
const ZOOM = 1.08;
/** Degrees of a drag across half of the picture. */
const REACH = 90;

export interface HandHandlers {
	/** Whether drags and keys turn the camera at present. */
	turns(): boolean;
	/** What is on show, if anything. */
	picture(): FurPicture | undefined;
	/** Called after a move of the light's target, and after one of the camera. */
	lit(): void;
	turned(): void;
	/** Called when a drag of the light begins and ends. */
	active(active: boolean): void;
}

export function listenToHands(canvas: HTMLCanvasElement, handlers: HandHandlers): void {
	const { turns, picture, lit, turned: moved, active } = handlers;
	const wanted = new Vector3();
	const turn = (azimuth: number, elevation: number, factor: number) => {
		const { camera } = picture() ?? {};
		if (!camera) return;
		const [a, e, d] = camera.orbit;
		camera.orbit = [a + azimuth, e + elevation, d * factor];
		moved();
	};
	const forCamera = ({ button, shiftKey }: PointerEvent) => button === 2 || (button === 0 && (shiftKey || turns()));
	listenToDrags(
		canvas,
		(pointer) => {
			const shown = picture();
			if (!shown) return;
			active(true);
			directionUnder(pointer, shown.camera, shown.centre, shown.lampRadius, wanted);
			shown.light.want((target) => target.copy(wanted));
			lit();
		},
		() => active(false),
		(event) => event.button === 0 && !forCamera(event),
	);
	let before: Vector2 | undefined;
	listenToDrags(
		canvas,
		(pointer) => {
			if (before) turn((before.x - pointer.x) * REACH, (before.y - pointer.y) * REACH, 1);
			before = (before ?? pointer.clone()).copy(pointer);
		},
		() => {
			before = undefined;
		},
		forCamera,
	);
	arrows(canvas, (right, up, { shiftKey }) => {
		if (shiftKey !== turns()) return turn(right * STEP, up * STEP, 1);
		picture()?.light.want((target) => turned(target, MathUtils.degToRad(right * STEP), MathUtils.degToRad(up * STEP)));
		lit();
	});
	canvas.addEventListener('keydown', (event) => {
		if (event.ctrlKey || event.altKey || event.metaKey) return;
		if (event.key === '+' || event.key === '=') turn(0, 0, 1 / ZOOM);
		else if (event.key === '-') turn(0, 0, ZOOM);
		else return;
		event.preventDefault();
	});
	canvas.addEventListener('contextmenu', (event) => event.preventDefault());
}
