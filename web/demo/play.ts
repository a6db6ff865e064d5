/** What hands do to the fur: a brush that strokes, wets and soils it, and a grip that shakes the body. */

import { Plane, Raycaster, Vector2, Vector3 } from 'three';
import type { View } from './address.ts';
import { Brush } from './brush.ts';
import { Drops } from './drops.ts';
import type { Living } from './living.ts';
import type { Looks } from './looks.ts';
import type { Picture } from './picture.ts';
import type { Act } from './tools.ts';

/** Radius of the brush, radii of the body; nearer by it becomes finer. */
const width = { stroke: 0.17, rain: 0.2, mud: 0.15 } as const;
/** What a second under the brush does: 1 is all. */
const rate = { rain: 3.5, mud: 4 } as const;
/** Of a key that is pressed once, or a tap, as of so many seconds. */
const press = 0.25;
/** Radii per second that an arrow key pushes the body by. */
const nudge = 1.6;
/** Share of the picture's height that an arrow key moves the ring by, per degree that it would turn the light by. */
const pace = 1 / 100;

type Paint = keyof typeof width;

const isPaint = (act: Act): act is Paint => Object.hasOwn(width, act);

export class Play {
	readonly brush = new Brush();
	readonly #drops = new Drops();
	readonly #picture: Picture;
	readonly #looks: Looks;
	readonly #living: Living;
	#act: Act = 'light';
	/** Where the pointer is, or the keys have moved the ring, normalised device coordinates; whether either is there. */
	readonly #pointer = new Vector2();
	#there = false;
	#pressed = false;
	/** Whether it has come down since the last frame. */
	#fresh = false;
	/** Whether keys have it, which have no place of their own. */
	#keys = false;
	/** Key presses that have not been followed yet. */
	#strokes = 0;
	/** Where the brush was in the frame before, world; whether it was on the fur there. */
	readonly #before = new Vector3();
	#on = false;
	/** Way of the last arrow key: a stroke by key goes along it. */
	readonly #way = new Vector2(0, -1);
	readonly #caster = new Raycaster();
	readonly #plane = new Plane();
	readonly #grip = new Vector3();
	readonly #hand = new Vector3();

	constructor(picture: Picture, looks: Looks, living: Living) {
		this.#picture = picture;
		this.#looks = looks;
		this.#living = living;
		picture.guides.add(this.brush);
		picture.stage.scene.add(this.#drops);
	}

	/** What a drag does. */
	set act(act: Act) {
		this.#act = act;
		this.#picture.canvas.dataset.act = act;
		this.#keys = this.#on = this.#pressed = this.#fresh = false;
		this.#living.sway.release();
		if (act === 'stroke' || act === 'move') this.#living.rehearse();
		this.#picture.request();
	}

	/** Whether the fur is wet or dirty, or about to be. */
	soils({ wet = 0, dirt = 0 }: View): boolean {
		return wet > 0 || dirt > 0 || this.#living.marked || this.#act === 'rain' || this.#act === 'mud';
	}

	/** Whether a drag is for the fur, or the body. */
	get takes(): boolean {
		return isPaint(this.#act) || this.#act === 'move';
	}

	/** A pointer comes down, or goes up. */
	press(pressed: boolean): void {
		if (!pressed && this.#fresh) this.#tap();
		this.#pressed = this.#fresh = pressed;
		this.#on = false;
		if (this.#act === 'move') {
			if (!pressed) this.#living.sway.release();
			else this.#plane.normal.setScalar(0);
		}
		this.#picture.request();
	}

	/** It moves, whether it is down or not. @param pointer in normalised device coordinates; undefined: it has gone */
	point(pointer: Vector2 | undefined): void {
		this.#there = pointer !== undefined;
		this.#keys = false;
		if (pointer) this.#pointer.copy(pointer);
		if (pointer && this.#pressed && this.#act === 'move') this.#pull();
		if (this.takes) this.#picture.request();
	}

	/** An arrow key: moves the ring, or pushes the body. @param right and up in degrees that it would turn the light by */
	arrow(right: number, up: number): void {
		const { camera } = this.#picture;
		if (this.#act === 'move') {
			this.#hand.set(right, up, 0).setLength(nudge).applyQuaternion(camera.quaternion);
			this.#living.sway.push(this.#hand);
		} else {
			this.#take();
			this.#way.set(right, up).normalize();
			const { x, y } = this.#pointer;
			this.#pointer.set(x + (right * pace) / camera.aspect, y + up * pace).clampScalar(-1, 1);
		}
		this.#picture.request();
	}

	/** Enter or the space bar: the brush does its work where its ring is, in the middle of the picture where there is none. */
	stroke(): void {
		if (!isPaint(this.#act)) return;
		this.#take();
		this.#strokes++;
		this.#picture.request();
	}

	#take(): void {
		if (!this.#keys && !this.#there) this.#pointer.setScalar(0);
		this.#keys = true;
	}

	/**
	 * Once a frame: shows the ring, has the brush do its work, and what lives go on.
	 *
	 * @returns milliseconds until another frame is wanted: 0 at once, Infinity none
	 */
	step(seconds: number): number {
		this.#fresh = false;
		const working = this.#brush(seconds);
		const falling = this.#drops.step(seconds, this.#picture.camera);
		const wait = this.#living.step(seconds);
		return working || falling ? 0 : wait;
	}

	/** @returns whether it goes on by itself */
	#brush(seconds: number): boolean {
		const { brush } = this;
		const { fur } = this.#looks;
		const act = this.#act;
		const there = this.#there || this.#keys;
		brush.visible = fur !== undefined && isPaint(act) && there && this.#aim(this.#pointer);
		if (!fur || !isPaint(act) || !brush.visible) {
			this.#on = false;
			this.#strokes = 0;
			return false;
		}
		const radius = this.#radius(act);
		brush.lie(radius, 0.6 * fur.shells.furLength);
		for (; this.#strokes > 0; this.#strokes--) this.#once(act, radius);
		if (this.#pressed) this.#work(act, radius, seconds);
		if (this.#pressed && act === 'rain' && !this.#picture.calm)
			this.#drops.pour(brush.place, brush.normal, radius, this.#picture.stage.closest, seconds);
		this.#before.copy(brush.place);
		this.#on = this.#pressed;
		// Rain goes on falling where a finger stays.
		return this.#pressed && act !== 'stroke';
	}

	#aim(pointer: Vector2): boolean {
		const { body } = this.#looks;
		return body !== undefined && this.brush.aim(pointer, this.#picture.camera, body.skin);
	}

	#radius(act: Paint): number {
		const { camera, stage } = this.#picture;
		return width[act] * stage.closest * Math.min(camera.orbit[2], 1);
	}

	/** From where it was to where it is. */
	#work(act: Paint, radius: number, seconds: number): void {
		const { place } = this.brush;
		const before = this.#on ? this.#before : place;
		if (act === 'stroke') {
			if (!before.equals(place)) this.#living.stroke(before, place, radius);
			return;
		}
		// A quick hand leaves no gaps.
		const dabs = Math.min(1 + Math.floor((2 * before.distanceTo(place)) / radius), 8);
		for (let i = 1; i <= dabs; i++)
			this.#living[act](this.#hand.lerpVectors(before, place, i / dabs), radius, rate[act] * seconds);
	}

	/** A tap, over before a frame has seen it; a stroke has no way then. */
	#tap(): void {
		const act = this.#act;
		if (this.#looks.fur && isPaint(act) && act !== 'stroke' && this.#aim(this.#pointer))
			this.#once(act, this.#radius(act));
	}

	/** What a key that is pressed once does. */
	#once(act: Paint, radius: number): void {
		const { place } = this.brush;
		if (act !== 'stroke') {
			this.#living[act](place, radius, rate[act] * press);
			return;
		}
		// Along the last arrow, through the ring.
		this.#hand.set(this.#way.x, this.#way.y, 0).multiplyScalar(1.5 * radius);
		this.#hand.applyQuaternion(this.#picture.camera.quaternion).projectOnPlane(this.brush.normal);
		this.#living.stroke(this.#before.copy(place).sub(this.#hand), this.#hand.add(place), radius);
	}

	/** Draws the body by the point where it was gripped, in the plane through it that faces the camera. */
	#pull(): void {
		const { camera, stage } = this.#picture;
		const { ray } = this.#caster;
		this.#caster.setFromCamera(this.#pointer, camera);
		if (this.#plane.normal.lengthSq() === 0) {
			this.#grip.copy(this.#aim(this.#pointer) ? this.brush.place : stage.centre);
			this.#plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(this.#hand), this.#grip);
			if (!ray.intersectPlane(this.#plane, this.#grip)) this.#plane.normal.setScalar(0);
			return;
		}
		if (!ray.intersectPlane(this.#plane, this.#hand)) return;
		this.#living.sway.pull(this.#hand.sub(this.#grip).divideScalar(stage.closest));
		this.#picture.request();
	}
}
