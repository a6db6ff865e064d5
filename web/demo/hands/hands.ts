/** Drags and keys on the picture: they act by the chosen tool. */

import { MathUtils, Vector2 } from 'three';
import { directionUnder, listenToDrags } from '../../page/aim.ts';
import { lampDistance } from '../../page/lamp/lamp.ts';
import { turned } from '../../page/light.ts';
import type { Picture } from '../stage/picture.ts';
import type { Gestures } from './gestures.ts';
import { listenToKeys } from './keys.ts';
import type { DragAction, Tools } from './tools.ts';

export interface HandHandlers {
	/** Called when a visitor has moved the light. */
	lightTaken(): void;
	/** Called when another action of drags is chosen. */
	chosen(act: DragAction): void;
	/** Called when a tool is used. */
	used(): void;
}

export function listenToHands(
	picture: Picture,
	tools: Tools,
	gestures: Gestures,
	{ lightTaken, chosen, used }: HandHandlers,
): void {
	const { canvas, camera, light, lamp, stage } = picture;
	const take = () => {
		lightTaken();
		picture.request();
	};
	listenToDrags(canvas, {
		allowed: () => !camera.dragTurns,
		active: (active) => {
			if (active) used();
			if (gestures.handlesDrag) return gestures.press(active);
			lamp.active = active;
			picture.request();
		},
		move: (pointer) => {
			if (gestures.handlesDrag) return gestures.point(pointer);
			light.want((wanted) => directionUnder(pointer, camera, stage.centre, stage.lampRadius * lampDistance, wanted));
			take();
		},
	});
	const hover = new Vector2();
	canvas.addEventListener('pointermove', ({ pointerType, buttons, clientX, clientY }) => {
		if (pointerType === 'touch' || buttons !== 0 || !gestures.handlesDrag) return;
		const { left, top, width, height } = canvas.getBoundingClientRect();
		gestures.point(hover.set(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2));
	});
	canvas.addEventListener('pointerleave', () => gestures.point(undefined));
	listenToKeys(canvas, tools.camera, {
		arrow: (right, up) => {
			if (camera.dragTurns) return camera.turn(right, up, 1);
			used();
			if (gestures.handlesDrag) return gestures.arrow(right, up);
			light.want((wanted) => turned(wanted, MathUtils.degToRad(right), MathUtils.degToRad(up)));
			take();
		},
		zoom: (factor) => camera.turn(0, 0, factor),
	});
	canvas.addEventListener('keydown', (event) => {
		if ((event.key !== 'Enter' && event.key !== ' ') || event.ctrlKey || event.altKey || event.metaKey) return;
		event.preventDefault();
		used();
		gestures.stroke();
	});
	tools.changed = (act) => {
		camera.dragTurns = act === 'camera';
		gestures.act = act;
		chosen(act);
	};
	canvas.addEventListener('contextmenu', (event) => event.preventDefault());
}
