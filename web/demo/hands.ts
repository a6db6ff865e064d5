/** Hands on the picture: drags and keys do what the chosen tool is for. */

import { MathUtils, Vector2 } from 'three';
import { directionUnder, listenToDrags } from '../page/aim.ts';
import { lampDistance } from '../page/lamp.ts';
import { turned } from '../page/light.ts';
import { listenToKeys } from './keys.ts';
import type { Picture } from './picture.ts';
import type { Play } from './play.ts';
import type { Act, Tools } from './tools.ts';

export interface HandHandlers {
	/** Somebody has moved the light. */
	lightTaken(): void;
	/** A drag does something else from now on. */
	chosen(act: Act): void;
	/** A tool is in use. */
	used(): void;
}

export function listenToHands(
	picture: Picture,
	tools: Tools,
	play: Play,
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
			if (play.takes) return play.press(active);
			lamp.active = active;
			picture.request();
		},
		move: (pointer) => {
			if (play.takes) return play.point(pointer);
			light.want((wanted) => directionUnder(pointer, camera, stage.centre, stage.radius * lampDistance, wanted));
			take();
		},
	});
	const hover = new Vector2();
	canvas.addEventListener('pointermove', ({ pointerType, buttons, clientX, clientY }) => {
		if (pointerType === 'touch' || buttons !== 0 || !play.takes) return;
		const { left, top, width, height } = canvas.getBoundingClientRect();
		play.point(hover.set(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2));
	});
	canvas.addEventListener('pointerleave', () => play.point(undefined));
	listenToKeys({
		arrow: (right, up) => {
			if (camera.dragTurns) return camera.turn(right, up, 1);
			used();
			if (play.takes) return play.arrow(right, up);
			light.want((wanted) => turned(wanted, MathUtils.degToRad(right), MathUtils.degToRad(up)));
			take();
		},
		zoom: (factor) => camera.turn(0, 0, factor),
	});
	canvas.addEventListener('keydown', (event) => {
		if ((event.key !== 'Enter' && event.key !== ' ') || event.ctrlKey || event.altKey || event.metaKey) return;
		event.preventDefault();
		used();
		play.stroke();
	});
	tools.changed = (act) => {
		camera.dragTurns = act === 'camera';
		play.act = act;
		chosen(act);
	};
	canvas.addEventListener('contextmenu', (event) => event.preventDefault());
}
