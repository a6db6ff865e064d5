/** Gaze of a body: its head turns towards a light, on top of what a clip does. */

import { type Bone, MathUtils, type Object3D, Quaternion, Vector3 } from 'three';
import { springOf } from '../../fur/reference.ts';

/** Name of the joint that turns; it looks along its own z, y is up. */
const HEAD = 'head';
/** How upright the head's y has to be at rest, cosine. */
const UPRIGHT = 0.8;
/** Farthest turns to a side, up and down, radians. */
const [ASIDE, UPWARD, DOWNWARD] = [38, 18, 14].map(MathUtils.degToRad) as [number, number, number];
/** Angles to a side between which a light behind the body loses its interest, radians. */
const [BEHIND, LOST] = [110, 160].map(MathUtils.degToRad) as [number, number];
/** Share of the turn to a side that the neck makes. */
const NECK = 0.4;
/** Swings per second; share of critical damping, by which it overshoots a hundredth at most. */
const FREQUENCY = 0.7;
const DAMPING = 0.85;
/** Radians, and per second, at which it has arrived. */
const REST = 5e-4;

const turn = new Quaternion();
const about = { x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0) };
const way = new Vector3();

/** A turn bounded by a limit, smoothly. */
const bounded = (angle: number, limit: number) => limit * Math.tanh(angle / limit);

export class Gaze {
	readonly #head: Object3D;
	readonly #neck: Object3D | undefined;
	/** How both rest, and what clips make of them. */
	readonly #rest: readonly [head: Quaternion, neck: Quaternion];
	readonly #posed: readonly [head: Quaternion, neck: Quaternion];
	/** To a side and down, radians, and per second. */
	readonly #turn = [0, 0];
	readonly #speed = [0, 0];
	readonly #wanted = [0, 0];
	readonly #target = new Vector3();
	#looks = false;

	/** The gaze of a body at rest; undefined for one without an upright joint named `head`. */
	static of(object: Object3D): Gaze | undefined {
		const head = object.getObjectByName(HEAD);
		if (!head || !(head as Bone).isBone) return undefined;
		object.updateMatrixWorld(true);
		return way.setFromMatrixColumn(head.matrixWorld, 1).normalize().y > UPRIGHT ? new Gaze(head) : undefined;
	}

	private constructor(head: Object3D) {
		const { parent } = head;
		this.#head = head;
		this.#neck = (parent as Bone | null)?.isBone ? (parent as Bone) : undefined;
		const both = () => [head.quaternion.clone(), this.#neck?.quaternion.clone() ?? new Quaternion()] as const;
		this.#rest = both();
		this.#posed = both();
	}

	/** @param direction to what it looks at, world axes, unit; undefined: straight on */
	aim(direction: Vector3 | undefined): void {
		this.#looks = direction !== undefined;
		if (direction) this.#target.copy(direction);
	}

	/** True while it has not arrived. */
	get moves(): boolean {
		this.#want();
		return this.#wanted.some(
			(angle, i) => Math.abs(angle - (this.#turn[i] as number)) > REST || Math.abs(this.#speed[i] as number) > REST,
		);
	}

	/** Takes the turn off the joints; call before a clip moves them. */
	lift(): void {
		this.#head.quaternion.copy(this.#posed[0]);
		this.#neck?.quaternion.copy(this.#posed[1]);
	}

	/** Turns the joints on from where a clip has brought them. @param seconds since the last call */
	apply(seconds: number): void {
		this.#posed[0].copy(this.#head.quaternion);
		if (this.#neck) this.#posed[1].copy(this.#neck.quaternion);
		this.#want();
		const { xx, xv, vx, vv } = springOf(FREQUENCY, DAMPING, seconds);
		for (const [i, wanted] of this.#wanted.entries()) {
			const [offset, speed] = [(this.#turn[i] as number) - wanted, this.#speed[i] as number];
			this.#turn[i] = wanted + xx * offset + xv * speed;
			this.#speed[i] = vx * offset + vv * speed;
		}
		const [aside, down] = this.#turn as [number, number];
		const share = this.#neck ? NECK : 0;
		this.#neck?.quaternion.multiply(turn.setFromAxisAngle(about.y, share * aside));
		this.#head.quaternion.multiply(turn.setFromAxisAngle(about.y, (1 - share) * aside));
		this.#head.quaternion.multiply(turn.setFromAxisAngle(about.x, down));
	}

	/** Finds the turn that is wanted, seen from the body as it stands now, with head and neck at rest. */
	#want(): void {
		this.#wanted.fill(0);
		if (!this.#looks) return;
		const [head, neck] = this.#rest;
		const base = this.#neck ?? this.#head;
		if (base.parent) base.parent.getWorldQuaternion(turn);
		else turn.identity();
		if (this.#neck) turn.multiply(neck);
		way.copy(this.#target).applyQuaternion(turn.multiply(head).invert());
		const aside = Math.atan2(way.x, way.z);
		const down = Math.atan2(-way.y, Math.hypot(way.x, way.z));
		const interest = 1 - MathUtils.smoothstep(Math.abs(aside), BEHIND, LOST);
		this.#wanted[0] = interest * bounded(aside, ASIDE);
		this.#wanted[1] = interest * bounded(down, down < 0 ? UPWARD : DOWNWARD);
	}
}
