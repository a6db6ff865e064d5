/** Shared light of the lesson: moved in any figure, it moves in all. */

import { MathUtils, type Vector3 } from 'three';
import { MovingLight, type Triple, turned } from '../page/light.ts';

/** Lowest height of the light on the unit sphere, where the lesson's dome ends. */
const LOWEST = Math.sin(MathUtils.degToRad(4));

/** Seconds between two pictures while drifting. */
const DRIFT_FRAME = 1 / 36;

export type LightListener = (direction: Vector3) => void;

export class SharedLight {
	readonly #moving: MovingLight;
	readonly #listeners = new Set<LightListener>();
	readonly #calm: { readonly on: boolean };
	readonly #wake: () => void;
	/** Seconds since the last step. */
	#late = 0;
	#moved = false;

	/**
	 * @param first initial direction to the lamp
	 * @param calm while it is on the light does not drift, and jumps to its target
	 * @param wake requests a call of `step` in the next frame
	 */
	constructor(first: Triple, calm: { readonly on: boolean }, wake: () => void) {
		this.#moving = new MovingLight(true);
		this.#moving.put(first, true);
		this.#calm = calm;
		this.#wake = wake;
	}

	/** Unit vector to the lamp in world axes: x right, y up, z towards the reader. Always above the horizon: y > 0. */
	get direction(): Readonly<Vector3> {
		return this.#moving.direction;
	}

	/** Whether the light drifts, as it does until it is set; held while calm is on. */
	get drifting(): boolean {
		return this.#moving.drifting;
	}

	/** Whether anybody has set the light. */
	get moved(): boolean {
		return this.#moved;
	}

	/** Sets the light's target, raised to the horizon if below. */
	set(x: number, y: number, z: number): void {
		this.#want((wanted) => wanted.set(x, y, z).normalize());
	}

	/** Turns the light's target about the upright axis, and up; radians. */
	turn(azimuth: number, elevation: number): void {
		this.#want((wanted) => turned(wanted, azimuth, elevation));
	}

	#want(set: (wanted: Vector3) => void): void {
		this.#moved = true;
		this.#moving.want((wanted) => {
			set(wanted);
			if (wanted.y >= LOWEST) return;
			const along = Math.hypot(wanted.x, wanted.z);
			const [x, z] = along > 0 ? [wanted.x / along, wanted.z / along] : [0, 1];
			const out = Math.sqrt(1 - LOWEST * LOWEST);
			wanted.set(x * out, LOWEST, z * out);
		});
		this.#wake();
	}

	/** Calls back now and whenever the light has moved. @returns function that unsubscribes */
	listen(listener: LightListener): () => void {
		this.#listeners.add(listener);
		listener(this.#moving.direction);
		return () => this.#listeners.delete(listener);
	}

	/** @param elapsed seconds since the last frame; @returns whether it is still moving */
	step(elapsed: number): boolean {
		const { on: calm } = this.#calm;
		if (this.drifting && calm) {
			this.#late = 0;
			return false;
		}
		this.#late += elapsed;
		// The drift is slow: half of the frames are enough.
		if (this.drifting && this.#late < DRIFT_FRAME) return true;
		const moved = this.#moving.step(calm ? Number.POSITIVE_INFINITY : this.#late);
		this.#late = 0;
		if (!moved) return false;
		for (const listener of this.#listeners) listener(this.#moving.direction);
		return true;
	}
}
