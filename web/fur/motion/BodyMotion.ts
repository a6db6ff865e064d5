import { type Mesh, Sphere, Vector3 } from 'three';
import type { FurFollicles } from '../body/FurFollicles.ts';
import type { Joints } from '../body/joints/joints.ts';
import { Placements } from '../body/joints/Placements.ts';
import { Morphs } from '../body/Morphs.ts';
import { type Drive, JOINT } from './drive.ts';
import { MorphMotion } from './MorphMotion.ts';

/** Displacement of the longest tips by gravity on a wall, share of the length. */
const SAG = 0.3;
/**
 * Time constant with which hairs follow the skin's velocity, seconds: smooths the jerks of a pointer, and the steps of a
 * velocity that only changes from frame to frame.
 */
const LAG = 1 / 25;
/** Upper bound of the skin's velocity as hairs feel it, ω times their length. */
const MAX_SPEED = 1.2;
/** Velocity below which the skin stands still, lengths of the fur per second. */
const MIN_SPEED = 1e-3;

const down = new Vector3(0, -1, 0);

/**
 * Motion of a body as its hairs feel it: gravity from another side than baked, and inertia.
 *
 * A root is the weighted mean of where its joints take it, so its velocity is that of theirs, and all of this is kept for
 * each joint. Within a frame a joint moves straight on; between frames its velocity changes at once, and tips lag by the
 * change. That needs no second differences, which are late and noisy, and is equal to second order for frames of any length.
 */
export class BodyMotion {
	readonly #joints: Joints;
	readonly #placements: Placements;
	readonly #morphs: MorphMotion | undefined;
	/** Bounding sphere of the body, its mesh's units. */
	readonly #sphere: Sphere;
	readonly #furLength: number;
	readonly #fastest: number;
	/** Downward direction in the baked pose, the mesh's axes. */
	readonly #bakedDown = new Vector3();
	/** Placements at the frame's beginning and end, at the last end of a sub-step, and in its middle; column-major matrices. */
	readonly #from: Float64Array;
	readonly #to: Float64Array;
	readonly #last: Float64Array;
	readonly #middle: Float64Array;
	#placed = false;
	/** Velocities, column-major matrices: (position, 1) → lengths of the fur per second in the world; three rows count. */
	readonly #skin: Float64Array;
	readonly #felt: Float64Array;
	readonly #feltBefore: Float64Array;
	readonly #rest: Float64Array;
	/** Centre of the body in the world. */
	readonly #centre = new Float64Array(3);

	/**
	 * @param mesh shells' mesh; its own placement is the baked pose
	 * @param joints of its follicles
	 * @param furLength longest fur as baked, the mesh's own units
	 * @param pace ω of the fur
	 * @param influences weights of the body's morph targets
	 */
	constructor(
		mesh: Mesh,
		follicles: FurFollicles,
		joints: Joints,
		furLength: number,
		pace: number,
		influences: () => readonly number[],
	) {
		const { count, position } = follicles;
		this.#joints = joints;
		this.#placements = new Placements(mesh, joints);
		this.#bakedDown.copy(down).applyQuaternion(mesh.quaternion.clone().conjugate());
		const points = Array.from({ length: count }, (_, i) => new Vector3().fromArray(position, 3 * i));
		this.#sphere = new Sphere().setFromPoints(points);
		this.#furLength = furLength;
		this.#fastest = MAX_SPEED * pace;
		const morphs = Morphs.of(mesh.geometry);
		if (morphs) this.#morphs = new MorphMotion(morphs, follicles, influences, furLength, this.#fastest);
		const matrices = () => new Float64Array(16 * joints.bones.length);
		[this.#from, this.#to, this.#last, this.#middle] = [matrices(), matrices(), matrices(), matrices()];
		[this.#skin, this.#felt, this.#feltBefore, this.#rest] = [matrices(), matrices(), matrices(), matrices()];
		for (let i = 0; i < this.#to.length; i++) this.#to[i] = i % 5 === 0 ? 1 : 0;
	}

	/**
	 * Reads the body's present placement.
	 *
	 * @param seconds since the last call
	 * @returns whether it has moved
	 */
	look(seconds: number): boolean {
		this.#skin.fill(0);
		this.#from.set(this.#to);
		this.#placements.read(this.#to);
		const moved = this.#placed && differ(this.#to, this.#from);
		const changed = this.#morphs?.look(seconds) && this.#placed;
		if (!this.#placed || (moved && !this.#measure(seconds))) this.#settle();
		return moved || changed === true;
	}

	/** Forget all motion. */
	place(): void {
		this.#placements.read(this.#to);
		this.#settle();
	}

	#settle(): void {
		for (const placement of [this.#from, this.#last, this.#middle]) placement.set(this.#to);
		for (const velocity of [this.#skin, this.#felt, this.#feltBefore]) velocity.fill(0);
		this.#morphs?.place();
		this.#placed = true;
	}

	/** Measure the velocities in this frame, bounded. @returns false for a jump to another place */
	#measure(seconds: number): boolean {
		const skin = this.#skin;
		const unit = this.#scale(this.#to) * this.#furLength;
		for (let i = 0; i < skin.length; i++)
			skin[i] = ((this.#to[i] as number) - (this.#from[i] as number)) / (seconds * unit);
		const { spheres } = this.#joints;
		for (let joint = 0; joint < spheres.length; joint++) {
			const speed = speedOf(skin, joint, spheres[joint] as Sphere);
			// Jump: farther than the body's size, or turned by more than a quarter.
			if (!(speed * seconds * this.#furLength < 2 * this.#sphere.radius)) return false;
			const felt = 1 + speed / this.#fastest;
			for (let i = 16 * joint; i < 16 * joint + 16; i++) skin[i] = (skin[i] as number) / felt;
		}
		return true;
	}

	/** World units per unit of the mesh, mean of the joints. */
	#scale(placements: Float64Array): number {
		let scale = 0;
		const { shares } = this.#joints;
		for (let joint = 0; joint < shares.length; joint++)
			scale += (shares[joint] as number) * lengthOf(placements, 16 * joint);
		return scale || 1;
	}

	/** Advance within the frame: hairs catch up with the skin's velocity. */
	advance(seconds: number): void {
		const kept = Math.exp(-seconds / LAG);
		for (let i = 0; i < this.#skin.length; i++) {
			const skin = this.#skin[i] as number;
			this.#felt[i] = skin + kept * ((this.#felt[i] as number) - skin);
		}
		this.#morphs?.advance(kept);
	}

	/** Whether hairs have caught up; a negligible rest is dropped. */
	caughtUp(): boolean {
		for (let i = 0; i < this.#rest.length; i++) this.#rest[i] = (this.#skin[i] as number) - (this.#felt[i] as number);
		const { spheres } = this.#joints;
		for (let joint = 0; joint < spheres.length; joint++)
			if (speedOf(this.#rest, joint, spheres[joint] as Sphere) > MIN_SPEED) return false;
		if (this.#morphs && this.#morphs.rest > MIN_SPEED) return false;
		this.#felt.set(this.#skin);
		this.#morphs?.catchUp();
		return true;
	}

	/**
	 * Writes gravity, placements and kicks of a sub-step and ends it.
	 *
	 * @param share of the frame at the sub-step's end
	 * @param gravity over the baked one
	 */
	write(drive: Drive, share: number, gravity: number): void {
		const middle = this.#middle;
		for (let i = 0; i < middle.length; i++) {
			const from = this.#from[i] as number;
			const now = from + share * ((this.#to[i] as number) - from);
			// Forces are taken at the sub-step's middle.
			middle[i] = 0.5 * ((this.#last[i] as number) + now);
			this.#last[i] = now;
		}
		down.toArray(drive.pull);
		this.#bakedDown.toArray(drive.laid);
		for (let row = 0; row < 3; row++) {
			drive.pull[row] = SAG * gravity * (drive.pull[row] as number);
			drive.laid[row] = SAG * (drive.laid[row] as number);
		}
		drive.sags = this.sags(gravity);
		this.#writeJoints(drive);
		this.#morphs?.write(drive);
		this.#feltBefore.set(this.#felt);
	}

	/** Write placements about the body's centre, in its radii, and kicks. */
	#writeJoints(drive: Drive): void {
		const middle = this.#middle;
		const centre = this.#findCentre();
		const unit = this.#scale(middle) * (this.#sphere.radius || 1);
		drive.kicks = false;
		for (let i = 0, at = 0; i < middle.length; i += 16, at += JOINT) {
			for (let row = 0; row < 3; row++) {
				for (let column = 0; column < 4; column++) {
					const from = i + 4 * column + row;
					const place = (middle[from] as number) - (column === 3 ? (centre[row] as number) : 0);
					const change = (this.#felt[from] as number) - (this.#feltBefore[from] as number);
					drive.joints[at + 4 * row + column] = place / unit;
					drive.joints[at + 12 + 4 * row + column] = -change;
					drive.kicks ||= change !== 0;
				}
			}
		}
	}

	/** Centre of the body, mean of where its joints take it. */
	#findCentre(): Float64Array {
		const { x, y, z } = this.#sphere.center;
		const middle = this.#middle;
		this.#centre.fill(0);
		const { shares } = this.#joints;
		for (let joint = 0; joint < shares.length; joint++)
			for (let row = 0, at = 16 * joint; row < 3; row++, at++)
				this.#centre[row] =
					(this.#centre[row] as number) +
					(shares[joint] as number) *
						((middle[at] as number) * x +
							(middle[at + 4] as number) * y +
							(middle[at + 8] as number) * z +
							(middle[at + 12] as number));
		return this.#centre;
	}

	/** Whether gravity displaces hairs from where they were baked. */
	sags(gravity: number): boolean {
		const { x, y, z } = this.#bakedDown;
		for (let at = 0; at < this.#middle.length; at += 16) {
			// Down in the joint's axes, with their scale.
			const along = (column: number) =>
				(-gravity * (this.#middle[at + 4 * column + 1] as number)) / lengthOf(this.#middle, at + 4 * column);
			if ((along(0) - x) ** 2 + (along(1) - y) ** 2 + (along(2) - z) ** 2 >= 1e-12) return true;
		}
		return false;
	}
}

/** Whether any number differs; without a closure, since it runs in every frame. */
function differ(one: Float64Array, other: Float64Array): boolean {
	for (let i = 0; i < one.length; i++) if (one[i] !== other[i]) return true;
	return false;
}

/** Length of a column of a matrix. */
function lengthOf(matrix: Float64Array, at: number): number {
	return Math.hypot(matrix[at] as number, matrix[at + 1] as number, matrix[at + 2] as number);
}

/** Speed of a joint's centre and of the turn about it, lengths of the fur per second. */
function speedOf(velocity: Float64Array, joint: number, { center, radius }: Sphere): number {
	let [travel, turn] = [0, 0];
	for (let row = 0, at = 16 * joint; row < 3; row++, at++) {
		const x = velocity[at] as number;
		const y = velocity[at + 4] as number;
		const z = velocity[at + 8] as number;
		travel += (x * center.x + y * center.y + z * center.z + (velocity[at + 12] as number)) ** 2;
		turn += x * x + y * y + z * z;
	}
	return Math.sqrt(travel) + Math.sqrt(0.5 * turn) * radius;
}
