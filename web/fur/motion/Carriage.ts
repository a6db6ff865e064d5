import { BufferAttribute, BufferGeometry, Matrix4, type Object3D, Sphere, Vector3 } from 'three';
import type { Drive } from './drive.ts';
import { Turn } from './Turn.ts';

/** Where gravity takes the tips of the longest fur on a wall, share of the length. */
const SAG = 0.3;
/**
 * Seconds in which hairs feel the skin's velocity: the jerks of a pointer arrive rounded. The longer they are, the less
 * matters it that the velocity changes from frame to frame only.
 */
const YIELD = 1 / 25;
/** Velocity of the skin that hairs feel however fast it is, ω times their length. */
const FASTEST = 1.2;
/** Below it the skin stands still, lengths of the fur per second. */
const STILL = 1e-3;

const down = new Vector3(0, -1, 0);

/**
 * How a body is carried about, and what its hairs feel of that: gravity from another side than it was baked with, and their
 * own inertia.
 *
 * From frame to frame the body goes straight on, its velocity changes at once, and what changes is what tips stay behind
 * by. That needs no second differences, which would come a frame late and noisy; between frames of any length it is the
 * same to second order.
 */
export class Carriage {
	/** As the body is turned at the moment. */
	readonly turn = new Turn();
	/** Around the body, its mesh's units. */
	readonly sphere: Sphere;
	readonly #mesh: Object3D;
	readonly #furLength: number;
	readonly #fastest: number;
	/** Of the pose that was baked, the mesh's axes. */
	readonly #upright = new Vector3();
	/** Placements at the frame's beginning and end, and at the last two ends of sub-steps. */
	readonly #from = new Matrix4();
	readonly #to = new Matrix4();
	readonly #last = new Matrix4();
	readonly #now = new Matrix4();
	#placed = false;
	/** Velocities, matrices by columns: (position, 1) → lengths of the fur per second in the world; three rows count. */
	readonly #skin = new Float64Array(16);
	readonly #felt = new Float64Array(16);
	readonly #feltBefore = new Float64Array(16);
	readonly #rest = new Float64Array(16);
	readonly #vector = new Vector3();

	/**
	 * @param mesh whose own placement is how it was baked
	 * @param position of its vertices, three numbers each
	 * @param furLength longest fur as it was baked, the mesh's own units
	 * @param pace ω of the fur
	 */
	constructor(mesh: Object3D, position: Float32Array, furLength: number, pace: number) {
		this.#mesh = mesh;
		this.#upright.copy(down).applyQuaternion(mesh.quaternion.clone().conjugate());
		const points = new BufferGeometry().setAttribute('position', new BufferAttribute(position, 3));
		points.computeBoundingSphere();
		this.sphere = points.boundingSphere ?? new Sphere();
		this.#furLength = furLength;
		this.#fastest = FASTEST * pace;
	}

	/**
	 * Looks where the body is now.
	 *
	 * @param seconds since it was looked at last
	 * @returns whether it has moved
	 */
	look(seconds: number): boolean {
		this.#skin.fill(0);
		this.#from.copy(this.#to);
		this.#find();
		const moved = this.#placed && !this.#to.equals(this.#from);
		if (!this.#placed || (moved && !this.#measure(seconds))) this.place();
		return moved;
	}

	/** What is nowhere, by a scale of zero say, stays where it was. */
	#find(): void {
		const { matrixWorld } = this.#mesh;
		this.#mesh.updateWorldMatrix(true, false);
		if (Math.abs(matrixWorld.determinant()) > 0) this.#to.copy(matrixWorld);
	}

	/** Where it is, it has always been. */
	place(): void {
		this.#find();
		this.#from.copy(this.#to);
		this.#last.copy(this.#to);
		this.turn.between(this.#to, this.#to);
		this.#skin.fill(0);
		this.#felt.fill(0);
		this.#feltBefore.fill(0);
		this.#placed = true;
	}

	/** Velocity in this frame, bounded. @returns whether it is one, not a placement elsewhere */
	#measure(seconds: number): boolean {
		const { elements: to } = this.#to;
		const { elements: from } = this.#from;
		const unit = Math.hypot(to[0], to[1], to[2]) * this.#furLength;
		for (let i = 0; i < 16; i++) this.#skin[i] = ((to[i] as number) - (from[i] as number)) / (seconds * unit);
		const speed = this.#speed(this.#skin);
		// Farther than through itself, or turned by more than a quarter.
		if (!(speed * seconds * this.#furLength < 2 * this.sphere.radius)) return false;
		for (let i = 0; i < 16; i++) this.#skin[i] = (this.#skin[i] as number) / (1 + speed / this.#fastest);
		return true;
	}

	/** How fast the body's centre goes, and what turns about it, lengths of the fur per second. */
	#speed(velocity: Float64Array): number {
		const { center, radius } = this.sphere;
		let [travel, turn] = [0, 0];
		for (let row = 0; row < 3; row++) {
			const x = velocity[row] as number;
			const y = velocity[row + 4] as number;
			const z = velocity[row + 8] as number;
			travel += (x * center.x + y * center.y + z * center.z + (velocity[row + 12] as number)) ** 2;
			turn += x * x + y * y + z * z;
		}
		return Math.sqrt(travel) + Math.sqrt(0.5 * turn) * radius;
	}

	/** Goes on along the frame: hairs feel more of what the skin does. */
	advance(seconds: number): void {
		const kept = Math.exp(-seconds / YIELD);
		for (let i = 0; i < 16; i++) {
			const skin = this.#skin[i] as number;
			this.#felt[i] = skin + kept * ((this.#felt[i] as number) - skin);
		}
	}

	/** Whether hairs feel all there is; where next to nothing is missing they do from now on. */
	settles(): boolean {
		for (let i = 0; i < 16; i++) this.#rest[i] = (this.#skin[i] as number) - (this.#felt[i] as number);
		if (this.#speed(this.#rest) > STILL) return false;
		this.#felt.set(this.#skin);
		return true;
	}

	/**
	 * Writes sag and kick of a sub-step, and ends it.
	 *
	 * @param share of the frame at the sub-step's end
	 * @param gravity over the one that was baked
	 */
	write(drive: Drive, share: number, gravity: number): void {
		const { elements: from } = this.#from;
		const { elements: to } = this.#to;
		const { elements: now } = this.#now;
		for (let i = 0; i < 16; i++) now[i] = (from[i] as number) + share * ((to[i] as number) - (from[i] as number));
		// Forces are those of the sub-step's middle.
		this.turn.between(this.#last, this.#now);
		this.#last.copy(this.#now);
		this.sag(gravity).toArray(drive.sag);
		drive.kicks = false;
		for (let column = 0; column < 4; column++) {
			for (let row = 0; row < 3; row++) {
				const i = 4 * column + row;
				const change = (this.#felt[i] as number) - (this.#feltBefore[i] as number);
				this.#vector.setComponent(row, -change);
				drive.kicks ||= change !== 0;
			}
			this.turn.toMesh(this.#vector);
			drive.kick[column] = this.#vector.x;
			drive.kick[4 + column] = this.#vector.y;
			drive.kick[8 + column] = this.#vector.z;
		}
		this.#feltBefore.set(this.#felt);
	}

	/** Where gravity takes the tips of the longest fur, shares of the length: nowhere in the pose that was baked. */
	sag(gravity: number): Vector3 {
		const sag = this.turn.toMesh(this.#vector.copy(down)).multiplyScalar(gravity).sub(this.#upright);
		return sag.lengthSq() < 1e-12 ? sag.set(0, 0, 0) : sag.multiplyScalar(SAG);
	}
}
