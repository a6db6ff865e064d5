/** Direction of the light over time: drifts until it is first set, then eases to its target. */

import { MathUtils, Object3D, Spherical, Vector3 } from 'three';

/** x, y, z. */
export type Triple = [number, number, number];

/** First light, from the side: light from the front is flat. */
export const DEFAULT_LIGHT: Triple = [-0.82, 0.57, -0.02];
/** First camera: azimuth and elevation in degrees, distance in units of the one at which the model fits. */
export const DEFAULT_CAMERA: Triple = [0, 8, 1];

const easing = 0.06; // time constant of the light behind a finger, seconds
const round = 26; // seconds of one turn while drifting
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

	/** @param glides whether the light eases and drifts; else it jumps to its target */
	constructor(glides: boolean) {
		this.#glides = glides;
	}

	/** Whether the light drifts, as it does until it is set. */
	get drifting(): boolean {
		return this.#start !== undefined;
	}

	/** Target of the light. */
	get wanted(): Triple {
		return this.#wanted.toArray();
	}

	/** Set the light at once; `drift` lets it drift from there. */
	put(direction: Triple, drift: boolean): void {
		this.direction.set(...direction).normalize();
		this.#wanted.copy(this.direction);
		this.#start = drift && this.#glides ? this.direction.clone() : undefined;
		this.#time = 0;
	}

	/** @param set changes the target in place */
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
		// Opposite direction: any axis will do.
		if (this.#axis.lengthSq() < 1e-8)
			this.#axis.crossVectors(this.direction, Math.abs(this.direction.y) < 0.9 ? Object3D.DEFAULT_UP : right);
		this.direction.applyAxisAngle(this.#axis.normalize(), angle * (1 - Math.exp(-elapsed / easing))).normalize();
		return true;
	}
}
