/** Step 10: a square of fur in the wind, and under the hand. */

import { type Camera, MathUtils, Plane, Ray, type Vector2, Vector3 } from 'three';
import { FurMotion } from '../../fur/index.ts';
import { loadFurry } from '../assets.ts';
import { action, controlRow, slider } from '../controls.ts';
import type { Mount } from '../lesson.ts';
import { FurPatch, tiled } from '../patch.ts';
import { View } from '../view.ts';

const TILES = 4;
/** Squares of the mesh across, each corner with a spring. */
const CELLS = 24;
/** Of the hand, tile widths. */
const HAND = 0.42;
/** Share of the fur's height at which a finger touches it. */
const TOUCHED = 0.7;
/** Steps of the stroke that the button does. */
const STROKE_STEPS = 16;
/** To and fro: how far, tile widths; how often; seconds of all of it. */
const [SHAKE, SHAKES, SHAKEN] = [0.25, 3, 1.2];

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.wind;
	const { fur } = await loadFurry('pelt-fox', lesson);
	const patch = new FurPatch(fur, TILES, tiled(TILES, CELLS));
	Object.assign(patch.shells.material, { gloss: 0.1, backlight: 2 });
	const motion = new FurMotion(patch.fur);
	motion.wind.gusts = lesson.calm ? 0 : 1;

	const skin = new Plane(new Vector3(0, 1, 0), -TOUCHED * patch.height);
	const ray = new Ray();
	const [before, now] = [new Vector3(), new Vector3()];
	let touching = false;
	/** How much of the shaking is over, 0..1. */
	let shaken = 1;
	/** The place on the skin under a finger is left in `now`. */
	const touch = ({ x, y }: Vector2, camera: Camera) => {
		ray.origin.setFromMatrixPosition(camera.matrixWorld);
		ray.direction.set(x, y, 0.5).unproject(camera).sub(ray.origin).normalize();
		return ray.intersectPlane(skin, now)?.setY(0);
	};
	const view = new View(place, lesson, {
		label: words.picture,
		aspect: 16 / 9,
		azimuth: 24,
		elevation: 34,
		zoom: 1.25,
		centre: patch.middle,
		radius: TILES * 0.6,
		drag(pointer, camera) {
			if (!pointer || !touch(pointer, camera)) touching = false;
			else {
				if (touching) stroke(before, now);
				touching = true;
				before.copy(now);
			}
		},
	});
	view.add(patch);

	/** Shows where steady forces lead where nothing is to move; else it moves there. */
	const changed = () => {
		if (!lesson.calm) return lesson.painter.wake();
		motion.settle();
		view.redraw();
	};
	const stroke = (from: Vector3, to: Vector3) => {
		motion.stroke(from, to, HAND);
		changed();
	};
	lesson.painter.animate((elapsed) => {
		if (lesson.calm || !view.visible) return false;
		shaken = Math.min(shaken + elapsed / SHAKEN, 1);
		patch.position.x = SHAKE * Math.sin(2 * Math.PI * SHAKES * shaken) * Math.sin(Math.PI * shaken);
		const moving = motion.update(elapsed) || shaken < 1;
		if (moving) view.redraw();
		return moving;
	});

	const controls = controlRow(place);
	slider(controls, {
		label: words.wind,
		min: 0,
		max: 1,
		step: 0.05,
		value: 0.4,
		text: words.strength,
		input: (strength) => {
			motion.wind.strength = strength;
			changed();
		},
	});
	slider(controls, {
		label: words.direction,
		min: -180,
		max: 180,
		step: 15,
		value: 60,
		text: (degrees) => words.degrees(degrees),
		input: (degrees) => {
			const angle = MathUtils.degToRad(degrees);
			motion.wind.direction.set(Math.sin(angle), 0, Math.cos(angle));
			changed();
		},
	});
	action(controls, words.stroke, () => {
		const at = (i: number, to: Vector3) =>
			to.set((i / STROKE_STEPS - 0.5) * 0.8 * TILES, 0, 0.12 * TILES * Math.sin((i / STROKE_STEPS) * 2 * Math.PI));
		for (let i = 0; i < STROKE_STEPS; i++) stroke(at(i, before), at(i + 1, now));
	});
	if (lesson.calm) return;
	action(controls, words.shake, () => {
		shaken = 0;
		lesson.painter.wake();
	});
};
