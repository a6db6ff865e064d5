/** Player of a model's clips: one at a time, in a loop or held, with a fade from one to the next. Loaded with the first model that has some. */

import { type AnimationAction, type AnimationClip, AnimationMixer, Box3, type Mesh, type Object3D } from 'three';
import type { Gaze } from './Gaze.ts';
import { clipNames } from './names.ts';
import { Reach, type Room } from './Reach.ts';

/** Seconds of the fade between two clips. */
const FADE_TIME = 0.3;

interface Track {
	name: string;
	action: AnimationAction;
	reach: Reach;
}

const boxBefore = new Box3();

export class ClipPlayer {
	/** Unique names, in the file's order; the first is chosen at first. */
	readonly names: readonly string[];
	/** Box around the body in the whole of the chosen clip; it glides there while one fades into another. */
	readonly box = new Box3();
	/** Factor of the speed of playing. */
	speed = 1;
	/** Turns the head on top of the clips, where the body has one. */
	readonly gaze: Gaze | undefined;
	readonly #object: Object3D;
	readonly #mixer: AnimationMixer;
	readonly #tracks: readonly Track[];
	#track: Track;
	/** Clip that is being faded out, and the share of the present one. */
	#before: Track | undefined;
	#share = 1;
	#playing = false;
	/** True until the pose is on show. */
	#stale = true;

	/**
	 * Samples the clips for the room that the body needs.
	 *
	 * @param object at its place in the file; its bones are in it
	 * @param meshes of the body
	 * @param clips at least one
	 * @param rest room of the body at rest, which a clip keeps that needs hardly more
	 * @param gaze of the body
	 */
	constructor(object: Object3D, meshes: readonly Mesh[], clips: readonly AnimationClip[], rest?: Room, gaze?: Gaze) {
		this.#object = object;
		this.gaze = gaze;
		this.names = clipNames(clips);
		this.#mixer = new AnimationMixer(object);
		const outline = Reach.outline(meshes);
		this.#tracks = clips.map((clip, i) => {
			const action = this.#mixer.clipAction(clip);
			action.play();
			const pose = (time: number) => {
				action.time = time;
				this.#apply();
			};
			const reach = new Reach(outline, clip.duration, pose, rest);
			action.stop();
			return { name: this.names[i] as string, action, reach };
		});
		this.#track = this.#tracks[0] as Track;
		this.#track.action.play();
		this.#apply();
		this.box.copy(this.#track.reach.box);
	}

	/** Name of the chosen clip. */
	get name(): string {
		return this.#track.name;
	}

	/** Duration of the chosen clip, seconds. */
	get duration(): number {
		return this.#track.action.getClip().duration;
	}

	/** Seconds into the chosen clip. */
	get time(): number {
		return this.#track.action.time;
	}

	get playing(): boolean {
		return this.#playing;
	}

	/** True while the body moves: in a clip that plays, or after a light. */
	get moves(): boolean {
		return this.#playing || this.gaze?.moves === true;
	}

	/** Radius around the box's centre that holds the body in the whole of the chosen clip. */
	get radius(): number {
		return this.faded(({ radius }) => radius);
	}

	/** Chooses a clip, from its beginning. @param name one of `names` */
	choose(name: string): void {
		const next = this.#tracks.find((track) => track.name === name);
		if (!next || next === this.#track) return;
		this.#endFade();
		this.#before = this.#track;
		this.#share = 0;
		this.#track = next;
		next.action.reset().play();
		this.#stale = true;
		if (!this.#playing) this.#endFade();
	}

	/** Plays the chosen clip on from where it is. */
	play(): void {
		this.#playing = true;
	}

	/** Holds the chosen clip. @param time seconds; later than its end is its end */
	hold(time: number): void {
		const at = Math.min(time, this.duration);
		if (!this.#playing && this.time === at) return;
		this.#playing = false;
		this.#endFade();
		this.#track.action.time = at;
		this.#stale = true;
	}

	/** Moves on by some seconds. @returns true if the body has another pose */
	step(seconds: number): boolean {
		const moves = this.#playing && seconds > 0;
		if (!moves && !this.#stale && !this.gaze?.moves) return false;
		if (moves && this.#before) {
			this.#share += seconds / FADE_TIME;
			if (this.#share >= 1) this.#endFade();
		}
		this.#track.action.setEffectiveTimeScale(this.speed).setEffectiveWeight(this.#share);
		this.#before?.action.setEffectiveTimeScale(this.speed).setEffectiveWeight(1 - this.#share);
		this.#apply(moves ? seconds : 0, seconds);
		this.box.copy(this.#track.reach.box);
		this.#fade(this.#before?.reach.box, this.box);
		this.#stale = false;
		return true;
	}

	/** Brings the body to several moments of its loop in turn, evenly spread from the present one, and back to that. */
	eachPhase(count: number, call: (phase: number) => void): void {
		const { action } = this.#track;
		const { time } = action;
		for (let phase = count - 1; phase >= 0; phase--) {
			action.time = phase === 0 ? time : (time + (phase / count) * this.duration) % (this.duration || 1);
			this.#apply();
			call(phase);
		}
	}

	/** Box around the body in its pose, from its place in the file. */
	poseBox(target: Box3): Box3 {
		this.#track.reach.boxAt(this.time, target);
		const { reach, action } = this.#before ?? {};
		return this.#fade(reach?.boxAt(action?.time ?? 0, boxBefore), target);
	}

	/** Brings a box to where it is between that of the clip before, if any, and its own. */
	#fade(before: Box3 | undefined, target: Box3): Box3 {
		if (!before) return target;
		target.min.lerpVectors(before.min, target.min, this.#share);
		target.max.lerpVectors(before.max, target.max, this.#share);
		return target;
	}

	/** A value of the chosen clip, on its way from that of the clip before while one fades into the other. */
	faded(value: (reach: Reach) => number): number {
		const now = value(this.#track.reach);
		if (!this.#before) return now;
		const before = value(this.#before.reach);
		return before + this.#share * (now - before);
	}

	#endFade(): void {
		this.#before?.action.stop();
		this.#before = undefined;
		this.#share = 1;
	}

	/** @param seconds of the clip, and since the frame before */
	#apply(seconds = 0, elapsed = 0): void {
		this.gaze?.lift();
		this.#mixer.update(seconds);
		this.gaze?.apply(elapsed);
		this.#object.updateMatrixWorld(true);
	}

	dispose(): void {
		this.#mixer.stopAllAction();
		this.#mixer.uncacheRoot(this.#object);
	}
}
