/** How the body moves as a whole: after a hand on a soft spring, back when it is let go, and round as on a turntable. */

import { Vector3 } from 'three';
import { springOf } from '../fur/index.ts';

/** Swings per second, and share of critical damping: it swings past its place once that one can see. */
const frequency = 1.5;
const damping = 0.42;
/** Seconds of one turn of the table; seconds in which it comes back to where it began, about. */
const round = 24;
const back = 0.35;
/** Of units of the body's radius, and per second: below both it is at rest. */
const rest = 2e-4;
/** Radii that it can be drawn away; half as far it goes as far as the hand. */
const reach = 0.6;
/** Share of a way down: there is a ground. */
const down = 0.2;

export class Sway {
	/** Away from its place, in radii of the body, world axes. */
	readonly offset = new Vector3();
	/** Turn of the table, radians. */
	yaw = 0;
	readonly #velocity = new Vector3();
	readonly #wanted = new Vector3();
	#turning = false;

	/** Whether it turns, one turn in 24 seconds; where it ends, it comes back the shorter way. */
	set turning(on: boolean) {
		this.#turning = on;
		this.yaw = Math.atan2(Math.sin(this.yaw), Math.cos(this.yaw));
	}

	/** @param offset where a hand wants it, radii of the body; it gives way the less the farther it is drawn */
	pull(offset: Vector3): void {
		this.#wanted.copy(offset);
		if (offset.y < 0) this.#wanted.y *= down;
		const length = this.#wanted.length();
		if (length > 0) this.#wanted.multiplyScalar((reach * Math.tanh(length / reach)) / length);
	}

	/** Lets go of it. */
	release(): void {
		this.#wanted.setScalar(0);
	}

	/** Gives it a push. @param velocity radii per second */
	push(velocity: Vector3): void {
		this.#velocity.add(velocity);
	}

	/** At rest in its own place at once. */
	reset(): void {
		for (const vector of [this.offset, this.#velocity, this.#wanted]) vector.setScalar(0);
		this.yaw = 0;
	}

	/**
	 * The damped spring's own path, so that it is the same however long the steps are.
	 *
	 * @returns whether it has moved
	 */
	step(seconds: number): boolean {
		const swung = this.#swing(seconds);
		return this.#turn(seconds) || swung;
	}

	#swing(seconds: number): boolean {
		const { offset } = this;
		const velocity = this.#velocity;
		const wanted = this.#wanted;
		const still = offset.distanceToSquared(wanted) < rest ** 2 && velocity.lengthSq() < rest ** 2;
		if (still) {
			if (offset.equals(wanted)) return false;
			offset.copy(wanted);
			velocity.setScalar(0);
			return true;
		}
		const { xx, xv, vx, vv } = springOf(frequency, damping, seconds);
		for (let i = 0; i < 3; i++) {
			const y = offset.getComponent(i) - wanted.getComponent(i);
			const v = velocity.getComponent(i);
			offset.setComponent(i, wanted.getComponent(i) + xx * y + xv * v);
			velocity.setComponent(i, vx * y + vv * v);
		}
		return true;
	}

	#turn(seconds: number): boolean {
		if (this.#turning) this.yaw += (2 * Math.PI * seconds) / round;
		else if (this.yaw === 0) return false;
		else if (Math.abs(this.yaw) < rest) this.yaw = 0;
		else this.yaw *= Math.exp(-seconds / back);
		return true;
	}
}
