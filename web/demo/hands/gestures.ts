/** Gestures on the fur: a brush that strokes, wets and soils it, and a grip that shakes the body. */

import { Plane, Raycaster, Vector2, Vector3 } from 'three';
import type { Dynamics } from '../model/dynamics.ts';
import type { Looks } from '../model/looks.ts';
import type { Picture } from '../stage/picture.ts';
import { Brush } from './brush.ts';
import { Drops } from './drops.ts';
import type { DragAction } from './tools.ts';

/** Radius of the brush in radii of the body; smaller for a near camera. */
const BRUSH_RADIUS = { stroke: 0.17, rain: 0.2, mud: 0.15 } as const;
/** Wetness or dirt per second under the brush; 1 is all. */
const BRUSH_RATE = { rain: 3.5, mud: 4 } as const;
/** Seconds under the brush that a key press or a tap stands for. */
const KEY_PRESS = 0.25;
/** Speed that an arrow key gives the body, radii per second. */
const ARROW_PUSH = 1.6;
/** Way of the ring per arrow key: share of the picture's height per degree that the key would turn the light by. */
const ARROW_PACE = 1 / 100;

type Paint = keyof typeof BRUSH_RADIUS;

const isPaint = (act: DragAction): act is Paint => Object.hasOwn(BRUSH_RADIUS, act);

export class Gestures {
	readonly brush = new Brush();
	readonly #drops = new Drops();
	readonly #picture: Picture;
	readonly #looks: Looks;
	readonly #dynamics: Dynamics;
	#act: DragAction = 'light';
	/** Place of the pointer, or of the ring that keys move, in normalised device coordinates. */
	readonly #pointer = new Vector2();
	#hasPointer = false;
	#pressed = false;
	/** True until the first frame after the pointer has come down. */
	#isNewPress = false;
	/** True while keys move the ring. */
	#byKeys = false;
	/** Key presses for the next frame. */
	#strokes = 0;
	/** Place of the brush in the frame before, on the body at rest; used only if it was pressed on the fur there. */
	readonly #before = new Vector3();
	#wasOnFur = false;
	/** Direction of the last arrow key: a stroke by key goes along it. */
	readonly #lastArrow = new Vector2(0, -1);
	readonly #caster = new Raycaster();
	readonly #plane = new Plane();
	readonly #grip = new Vector3();
	readonly #scratch = new Vector3();
	readonly #end = new Vector3();
	readonly #aside = new Vector2();

	constructor(picture: Picture, looks: Looks, dynamics: Dynamics) {
		this.#picture = picture;
		this.#looks = looks;
		this.#dynamics = dynamics;
		picture.guides.add(this.brush);
		picture.stage.scene.add(this.#drops);
	}

	/** Action of a drag. */
	set act(act: DragAction) {
		this.#act = act;
		this.#picture.canvas.dataset.act = act;
		this.#byKeys = this.#wasOnFur = this.#pressed = this.#isNewPress = false;
		this.#dynamics.sway.release();
		this.#dynamics.brushStains = act === 'rain' || act === 'mud';
		if (act === 'stroke' || act === 'move') this.#dynamics.warmUp();
		this.#picture.request();
	}

	/** True for actions on the fur or the body. */
	get handlesDrag(): boolean {
		return isPaint(this.#act) || this.#act === 'move';
	}

	/** Handles a pointer that comes down or goes up. */
	press(pressed: boolean): void {
		if (!pressed && this.#isNewPress) this.#tap();
		this.#pressed = this.#isNewPress = pressed;
		this.#wasOnFur = false;
		if (this.#act === 'move') {
			if (!pressed) this.#dynamics.sway.release();
			else this.#plane.normal.setScalar(0);
		}
		this.#picture.request();
	}

	/** Handles a move of the pointer. @param pointer in normalised device coordinates; undefined once it has left */
	point(pointer: Vector2 | undefined): void {
		this.#hasPointer = pointer !== undefined;
		this.#byKeys = false;
		if (pointer) this.#pointer.copy(pointer);
		if (pointer && this.#pressed && this.#act === 'move') this.#pull();
		if (this.handlesDrag) this.#picture.request();
	}

	/** Moves the ring or pushes the body by an arrow key. @param right and up in degrees that it would turn the light by */
	arrow(right: number, up: number): void {
		const { camera } = this.#picture;
		if (this.#act === 'move') {
			this.#scratch.set(right, up, 0).setLength(ARROW_PUSH).applyQuaternion(camera.quaternion);
			this.#dynamics.sway.push(this.#scratch);
		} else {
			this.#takeByKeys();
			this.#lastArrow.set(right, up).normalize();
			const { x, y } = this.#pointer;
			this.#pointer.set(x + (right * ARROW_PACE) / camera.aspect, y + up * ARROW_PACE).clampScalar(-1, 1);
		}
		this.#picture.request();
	}

	/** Uses the brush once, by Enter or the space bar: at its ring, or else in the middle of the model's room. */
	stroke(): void {
		if (!isPaint(this.#act)) return;
		this.#takeByKeys();
		this.#strokes++;
		this.#picture.request();
	}

	#takeByKeys(): void {
		if (!this.#byKeys && !this.#hasPointer) this.#picture.middle(this.#pointer);
		this.#byKeys = true;
	}

	/**
	 * Shows the ring and uses the brush, once a frame.
	 *
	 * @returns milliseconds until another frame is wanted: 0 at once, Infinity none
	 */
	step(seconds: number): number {
		this.#isNewPress = false;
		const working = this.#useBrush(seconds);
		const falling = this.#drops.step(seconds, this.#picture.camera);
		return working || falling ? 0 : Number.POSITIVE_INFINITY;
	}

	/** @returns true while the brush works without a move */
	#useBrush(seconds: number): boolean {
		const { brush } = this;
		const { fur } = this.#looks;
		const act = this.#act;
		const there = this.#hasPointer || this.#byKeys;
		brush.visible = fur !== undefined && isPaint(act) && there && this.#aim(this.#pointer);
		if (!fur || !isPaint(act) || !brush.visible) {
			this.#wasOnFur = false;
			this.#strokes = 0;
			return false;
		}
		const radius = this.#radius(act);
		brush.lie(radius, 0.6 * fur.shells.furLength);
		for (; this.#strokes > 0; this.#strokes--) this.#dab(act, radius);
		if (this.#pressed) this.#work(act, radius, seconds);
		if (this.#pressed && act === 'rain' && !this.#picture.calm)
			this.#drops.pour(brush.place, brush.normal, radius, this.#picture.stage.bodyRadius, seconds);
		this.#before.copy(brush.rest);
		this.#wasOnFur = this.#pressed;
		// Rain falls on while a finger stays.
		return this.#pressed && act !== 'stroke';
	}

	#aim(pointer: Vector2): boolean {
		const { body } = this.#looks;
		return body !== undefined && this.brush.aim(pointer, this.#picture.camera, body);
	}

	#radius(act: Paint): number {
		const { camera, stage } = this.#picture;
		return BRUSH_RADIUS[act] * stage.bodyRadius * Math.min(camera.orbit[2], 1);
	}

	/** Uses the brush from its last place to this one. */
	#work(act: Paint, radius: number, seconds: number): void {
		const { rest } = this.brush;
		const before = this.#wasOnFur ? this.#before : rest;
		if (act === 'stroke') {
			if (!before.equals(rest)) this.#dynamics.stroke(before, rest, radius);
			return;
		}
		// A quick hand leaves no gaps.
		const dabs = Math.min(1 + Math.floor((2 * before.distanceTo(rest)) / radius), 8);
		for (let i = 1; i <= dabs; i++)
			this.#dynamics[act](this.#scratch.lerpVectors(before, rest, i / dabs), radius, BRUSH_RATE[act] * seconds);
	}

	/** Uses the brush for a tap that is over before a frame; a stroke needs a way. */
	#tap(): void {
		const act = this.#act;
		if (this.#looks.fur && isPaint(act) && act !== 'stroke' && this.#aim(this.#pointer))
			this.#dab(act, this.#radius(act));
	}

	/** Uses the brush for one key press or tap. */
	#dab(act: Paint, radius: number): void {
		const { place, rest } = this.brush;
		if (act !== 'stroke') {
			this.#dynamics[act](rest, radius, BRUSH_RATE[act] * KEY_PRESS);
			return;
		}
		// Along the last arrow, through the ring.
		this.#scratch.set(this.#lastArrow.x, this.#lastArrow.y, 0).multiplyScalar(1.5 * radius);
		this.#scratch.applyQuaternion(this.#picture.camera.quaternion).projectOnPlane(this.brush.normal);
		if (!place.equals(rest)) this.#wayAtRest(this.#scratch);
		this.#dynamics.stroke(this.#before.copy(rest).sub(this.#scratch), this.#scratch.add(rest), radius);
	}

	/** Turns a way from the ring over the posed body to that over the body at rest; unless it leads off the body. */
	#wayAtRest(way: Vector3): void {
		const { place, rest } = this.brush;
		const length = way.length();
		this.#before.copy(rest);
		this.#end.copy(place).add(way).project(this.#picture.camera);
		if (this.#aim(this.#aside.set(this.#end.x, this.#end.y)) && !rest.equals(this.#before))
			way.subVectors(rest, this.#before).setLength(length);
		this.#aim(this.#pointer);
	}

	/** Pulls the body by the gripped point, in the plane through it that faces the camera. */
	#pull(): void {
		const { camera, stage } = this.#picture;
		const { ray } = this.#caster;
		this.#caster.setFromCamera(this.#pointer, camera);
		if (this.#plane.normal.lengthSq() === 0) {
			this.#grip.copy(this.#aim(this.#pointer) ? this.brush.place : stage.centre);
			this.#plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(this.#scratch), this.#grip);
			if (!ray.intersectPlane(this.#plane, this.#grip)) this.#plane.normal.setScalar(0);
			return;
		}
		if (!ray.intersectPlane(this.#plane, this.#scratch)) return;
		this.#dynamics.sway.pull(this.#scratch.sub(this.#grip).divideScalar(stage.bodyRadius));
		this.#picture.request();
	}
}
