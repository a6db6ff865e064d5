/** The one light of the lesson: moved in any figure, it moves in all. */

import { MathUtils, type Vector3 } from 'three';
import { MovingLight, type Triple, turned } from '../page/light.ts';

/** How near the horizon it may sink, as its height on the unit sphere: the lesson's dome ends there. */
const LOWEST = Math.sin(MathUtils.degToRad(4));

/** Seconds between two pictures while it drifts. */
const DRIFT_FRAME = 1 / 36;

export type LightListener = (direction: Vector3) => void;

export class SharedLight {
	readonly #moving: MovingLight;
	readonly #listeners = new Set<LightListener>();
	readonly #wake: () => void;
	/** Seconds since the last step. */
	#late = 0;

	/**
	 * @param first direction to the lamp
	 * @param calm whether it jumps where it is wanted and never moves by itself
	 * @param wake has the next frame call `step`
	 */
	constructor(first: Triple, calm: boolean, wake: () => void) {
		this.#moving = new MovingLight(!calm);
		this.#moving.put(first, true);
		this.#wake = wake;
	}

	/** Unit vector to the lamp in world axes: x right, y up, z towards the reader. Of the upper half only: y > 0. */
	get direction(): Readonly<Vector3> {
		return this.#moving.direction;
	}

	/** True until somebody takes the light. */
	get drifting(): boolean {
		return this.#moving.drifting;
	}

	/** Takes the light; it glides there. What is below the horizon is raised to it. */
	set(x: number, y: number, z: number): void {
		this.#want((wanted) => wanted.set(x, y, z).normalize());
	}

	/** Takes the light and turns it about the upright axis, and up; radians. */
	turn(azimuth: number, elevation: number): void {
		this.#want((wanted) => turned(wanted, azimuth, elevation));
	}

	#want(set: (wanted: Vector3) => void): void {
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

	/** Calls back now and whenever the light has moved. @returns what ends it */
	listen(listener: LightListener): () => void {
		this.#listeners.add(listener);
		listener(this.#moving.direction);
		return () => this.#listeners.delete(listener);
	}

	/** @param elapsed seconds since the last frame; @returns whether it is still on its way */
	step(elapsed: number): boolean {
		this.#late += elapsed;
		// By itself it is slow: half of the frames do, and the machine stays cool.
		if (this.drifting && this.#late < DRIFT_FRAME) return true;
		const moved = this.#moving.step(this.#late);
		this.#late = 0;
		if (!moved) return false;
		for (const listener of this.#listeners) listener(this.#moving.direction);
		return true;
	}
}
