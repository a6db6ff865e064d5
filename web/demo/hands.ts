/** Hands on the picture: drags, arrow keys and the camera button. */

import { MathUtils } from 'three';
import { directionUnder, listenToDrags } from '../page/aim.ts';
import { lampDistance } from '../page/lamp.ts';
import { turned } from '../page/light.ts';
import { listenToKeys } from './keys.ts';
import type { Picture } from './picture.ts';

/**
 * @param orbit the button that lets a drag turn the camera
 * @param lightTaken called whenever somebody has moved the light
 */
export function listenToHands(picture: Picture, orbit: HTMLButtonElement, lightTaken: () => void): void {
	const { canvas, camera, light, lamp, stage } = picture;
	const take = () => {
		lightTaken();
		picture.request();
	};
	listenToDrags(canvas, {
		allowed: () => !camera.dragTurns,
		active: (active) => {
			lamp.active = active;
			picture.request();
		},
		move: (pointer) => {
			light.want((wanted) => directionUnder(pointer, camera, stage.centre, stage.radius * lampDistance, wanted));
			take();
		},
	});
	listenToKeys({
		arrow: (right, up) => {
			if (camera.dragTurns) return camera.turn(right, up, 1);
			light.want((wanted) => turned(wanted, MathUtils.degToRad(right), MathUtils.degToRad(up)));
			take();
		},
		zoom: (factor) => camera.turn(0, 0, factor),
	});
	orbit.addEventListener('click', () => {
		camera.dragTurns = !camera.dragTurns;
		orbit.setAttribute('aria-pressed', String(camera.dragTurns));
	});
	canvas.addEventListener('contextmenu', (event) => event.preventDefault());
}
