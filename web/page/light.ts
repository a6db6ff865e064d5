/** The light's direction over time: drifting by itself until somebody takes it, then gliding where it is wanted. */

import { MathUtils, Object3D, Spherical, Vector3 } from 'three';

/** x, y, z. */
export type Triple = [number, number, number];

const easing = 0.06; // seconds in which the light follows a finger
const round = 26; // seconds of one turn by itself
const arrived = 1e-4; // radians

const right = new Vector3(1, 0, 0);
const spherical = new Spherical();

/** Turns a direction about the upright axis and raises it, both in radians; stops at the poles. */
export function turned(direction: Vector3, azimuth: number, elevation: number): Vector3 {
	spherical.setFromVector3(direction);
	spherical.theta += azimuth;
	spherical.phi = MathUtils.clamp(spherical.phi - elevation, 0.02, Math.PI - 0.02);
	return direction.setFromSpherical(spherical);
}

export class MovingLight {
	/** Unit vector from the model to the lamp, world axes. */
	readonly direction = new Vector3(0, 0, 1);
	readonly #wanted = new Vector3(0, 0, 1);
	readonly #axis = new Vector3();
	readonly #glides: boolean;
	#start: Vector3 | undefined;
	#time = 0;

	/** @param glides false: the light jumps where it is wanted, and nothing moves by itself */
	constructor(glides: boolean) {
		this.#glides = glides;
	}

	/** True until somebody takes the light. */
	get drifting(): boolean {
		return this.#start !== undefined;
	}

	/** Where the light is going, or is. */
	get wanted(): Triple {
		return this.#wanted.toArray();
	}

	/** Puts the light somewhere, without a way; `drift` lets it wander from there. */
	put(direction: Triple, drift: boolean): void {
		this.direction.set(...direction).normalize();
		this.#wanted.copy(this.direction);
		this.#start = drift && this.#glides ? this.direction.clone() : undefined;
		this.#time = 0;
	}

	/** @param set changes the wanted direction, which it is given */
	want(set: (wanted: Vector3) => void): void {
		if (this.#start) this.#wanted.copy(this.direction);
		this.#start = undefined;
		set(this.#wanted);
	}

	/** @param elapsed seconds since the last frame; @returns whether the light has moved */
	step(elapsed: number): boolean {
		if (this.#start) {
			this.#time += elapsed;
			const turn = (this.#time / round) * 2 * Math.PI;
			turned(this.direction.copy(this.#start), turn, 0.22 * Math.sin(1.7 * turn));
			return true;
		}
		const angle = this.direction.angleTo(this.#wanted);
		if (angle === 0) return false;
		if (!this.#glides || angle < arrived) {
			this.direction.copy(this.#wanted);
			return true;
		}
		this.#axis.crossVectors(this.direction, this.#wanted);
		// Straight opposite: any way around will do.
		if (this.#axis.lengthSq() < 1e-8)
			this.#axis.crossVectors(this.direction, Math.abs(this.direction.y) < 0.9 ? Object3D.DEFAULT_UP : right);
		this.direction.applyAxisAngle(this.#axis.normalize(), angle * (1 - Math.exp(-elapsed / easing))).normalize();
		return true;
	}
}
