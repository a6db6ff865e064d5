/** A square of fur in the wind, and under the hand. */

import { type Camera, MathUtils, Plane, Ray, type Vector2, Vector3 } from 'three';
import { FurMotion } from '../../fur/index.ts';
import { action, controlRow, slider } from '../controls.ts';
import { loadFurry } from '../data/assets.ts';
import type { Mount } from '../lesson.ts';
import { FurPatch, tiled } from '../patch.ts';
import { View, type WindowOptions } from '../view.ts';
import type { Words } from '../words/index.ts';

const TILES = 4;
/** Squares of the mesh across, each corner with a spring. */
const CELLS = 24;
/** Radius of the hand, tile widths. */
const HAND = 0.42;
/** Height at which a finger touches the fur, share of the fur's. */
const TOUCHED = 0.7;
/** Steps of the button's stroke. */
const STROKE_STEPS = 16;
/** Shaking: amplitude in tile widths, number of swings, duration in seconds. */
const [SHAKE, SHAKES, SHAKEN] = [0.25, 3, 1.2];
/** Spacing of shells over the best; fewer are enough in motion. */
const COARSE = 1.5;
/** Where the picture is taken from. */
const SEEN = { aspect: 16 / 9, azimuth: 24, elevation: 34, zoom: 1.25 };

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.wind;
	const { fur } = await loadFurry('pelt-fox', lesson);
	const patch = new FurPatch(fur, TILES, tiled(TILES, CELLS));
	Object.assign(patch.shells.material, { gloss: 0.1, backlight: 2 });
	patch.shells.coarseness = COARSE;
	const motion = new FurMotion(patch.fur);

	/** Elapsed share of the shaking, 0..1. */
	let shaken = 1;
	const view = new View(place, lesson, {
		label: words.picture,
		...SEEN,
		centre: patch.middle,
		radius: TILES * 0.6,
		drag: strokesOf(TOUCHED * patch.height, (from, to) => stroke(from, to)),
	});
	view.add(patch);

	/** Jump to the equilibrium if the page is still; else move there. */
	const changed = () => {
		if (!lesson.calm.on) return lesson.painter.wake();
		motion.settle();
		view.redraw();
	};
	const stroke = (from: Vector3, to: Vector3) => {
		motion.stroke(from, to, HAND);
		changed();
	};
	lesson.painter.animate((elapsed) => {
		if (lesson.calm.on || !view.visible) return false;
		shaken = Math.min(shaken + elapsed / SHAKEN, 1);
		patch.position.x = SHAKE * Math.sin(2 * Math.PI * SHAKES * shaken) * Math.sin(Math.PI * shaken);
		const moving = patch.fur.update(elapsed) || shaken < 1;
		if (moving) view.redraw();
		return moving;
	});

	const controls = controlRow(place);
	sliders(controls, words, motion, changed);
	action(controls, words.stroke, () => strokeOnce(stroke));
	const shake = action(controls, words.shake, () => {
		shaken = 0;
		lesson.painter.wake();
	});
	lesson.calm.listen((calm) => {
		motion.wind.gusts = calm ? 0 : 1;
		shake.hidden = calm;
		if (calm) {
			shaken = 1;
			patch.position.x = 0;
		}
		changed();
	});
};

/** Drags as strokes along the skin. @param height of the plane touched */
function strokesOf(height: number, stroke: (from: Vector3, to: Vector3) => void): WindowOptions['drag'] {
	const [before, now] = [new Vector3(), new Vector3()];
	const touch = touchAt(height, now);
	let touching = false;
	return (pointer, camera) => {
		if (!pointer || !touch(pointer, camera)) {
			touching = false;
			return;
		}
		if (touching) stroke(before, now);
		touching = true;
		before.copy(now);
	};
}

/** Ray cast from a finger. @param height of the plane touched; @param place takes the place on the skin below */
function touchAt(height: number, place: Vector3): (pointer: Vector2, camera: Camera) => Vector3 | undefined {
	const plane = new Plane(new Vector3(0, 1, 0), -height);
	const ray = new Ray();
	return ({ x, y }, camera) => {
		ray.origin.setFromMatrixPosition(camera.matrixWorld);
		ray.direction.set(x, y, 0.5).unproject(camera).sub(ray.origin).normalize();
		return ray.intersectPlane(plane, place)?.setY(0);
	};
}

/** Sliders of the wind. */
function sliders(controls: HTMLElement, words: Words['wind'], { wind }: FurMotion, changed: () => void): void {
	slider(controls, {
		label: words.wind,
		min: 0,
		max: 1,
		step: 0.05,
		value: 0.4,
		text: words.strength,
		input: (strength) => {
			wind.strength = strength;
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
			wind.direction.set(Math.sin(angle), 0, Math.cos(angle));
			changed();
		},
	});
}

/** Strokes the fur along a wave through the square. */
function strokeOnce(stroke: (from: Vector3, to: Vector3) => void): void {
	const [from, to] = [new Vector3(), new Vector3()];
	const place = (i: number, target: Vector3) =>
		target.set((i / STROKE_STEPS - 0.5) * 0.8 * TILES, 0, 0.12 * TILES * Math.sin((i / STROKE_STEPS) * 2 * Math.PI));
	for (let i = 0; i < STROKE_STEPS; i++) stroke(place(i, from), place(i + 1, to));
}
