/** Motion of the body as a whole: after a hand on a soft spring, back when released, and round on a turntable. */

import { Vector3 } from 'three';
import { springOf } from '../../fur/reference.ts';

/** Swings per second; share of critical damping, which leaves one visible overshoot. */
const FREQUENCY = 1.5;
const DAMPING = 0.42;
/** Seconds of a turn of the table; time constant of the way back, seconds. */
const TURN_TIME = 24;
const RETURN_TIME = 0.35;
/** Offset and speed of rest, in radii of the body and per second. */
const REST = 2e-4;
/** Largest offset, radii; small ones follow the hand. */
const MAX_PULL = 0.6;
/** Factor of offsets downwards: there is a ground. */
const DOWNWARD_SHARE = 0.2;

export class Sway {
	/** Offset from its place, in radii of the body, world axes. */
	readonly offset = new Vector3();
	/** Turn of the table, radians. */
	yaw = 0;
	readonly #velocity = new Vector3();
	readonly #wanted = new Vector3();
	#turning = false;

	/** Starts and stops the turntable; stopped, the body turns back the shorter way. */
	set turning(on: boolean) {
		this.#turning = on;
		this.yaw = Math.atan2(Math.sin(this.yaw), Math.cos(this.yaw));
	}

	/** @param offset of the hand, radii of the body; larger ones are followed less */
	pull(offset: Vector3): void {
		this.#wanted.copy(offset);
		if (offset.y < 0) this.#wanted.y *= DOWNWARD_SHARE;
		const length = this.#wanted.length();
		if (length > 0) this.#wanted.multiplyScalar((MAX_PULL * Math.tanh(length / MAX_PULL)) / length);
	}

	/** Releases the body. */
	release(): void {
		this.#wanted.setScalar(0);
	}

	/** Pushes the body. @param velocity radii per second */
	push(velocity: Vector3): void {
		this.#velocity.add(velocity);
	}

	/** Puts the body at rest in its place at once. */
	reset(): void {
		for (const vector of [this.offset, this.#velocity, this.#wanted]) vector.setScalar(0);
		this.yaw = 0;
	}

	/**
	 * Moves on along the damped spring's exact path, which does not depend on the steps.
	 *
	 * @returns true if it has moved
	 */
	step(seconds: number): boolean {
		const swung = this.#swing(seconds);
		return this.#turn(seconds) || swung;
	}

	#swing(seconds: number): boolean {
		const { offset } = this;
		const velocity = this.#velocity;
		const wanted = this.#wanted;
		const still = offset.distanceToSquared(wanted) < REST ** 2 && velocity.lengthSq() < REST ** 2;
		if (still) {
			if (offset.equals(wanted)) return false;
			offset.copy(wanted);
			velocity.setScalar(0);
			return true;
		}
		const { xx, xv, vx, vv } = springOf(FREQUENCY, DAMPING, seconds);
		for (let i = 0; i < 3; i++) {
			const y = offset.getComponent(i) - wanted.getComponent(i);
			const v = velocity.getComponent(i);
			offset.setComponent(i, wanted.getComponent(i) + xx * y + xv * v);
			velocity.setComponent(i, vx * y + vv * v);
		}
		return true;
	}

	#turn(seconds: number): boolean {
		if (this.#turning) this.yaw += (2 * Math.PI * seconds) / TURN_TIME;
		else if (this.yaw === 0) return false;
		else if (Math.abs(this.yaw) < REST) this.yaw = 0;
		else this.yaw *= Math.exp(-seconds / RETURN_TIME);
		return true;
	}
}
