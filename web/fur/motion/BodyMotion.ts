import { BufferAttribute, BufferGeometry, Matrix4, type Object3D, Sphere, Vector3 } from 'three';
import type { Drive } from './drive.ts';
import { Turn } from './Turn.ts';

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
 * Within a frame the body moves straight on; between frames its velocity changes at once, and tips lag by the change. That
 * needs no second differences, which are late and noisy, and is equal to second order for frames of any length.
 */
export class BodyMotion {
	/** Present orientation of the body. */
	readonly turn = new Turn();
	/** Bounding sphere of the body, its mesh's units. */
	readonly sphere: Sphere;
	readonly #mesh: Object3D;
	readonly #furLength: number;
	readonly #fastest: number;
	/** Downward direction in the baked pose, the mesh's axes. */
	readonly #bakedDown = new Vector3();
	/** Placements at the frame's beginning and end, and at the last two ends of sub-steps. */
	readonly #from = new Matrix4();
	readonly #to = new Matrix4();
	readonly #last = new Matrix4();
	readonly #now = new Matrix4();
	#placed = false;
	/** Velocities, column-major matrices: (position, 1) → lengths of the fur per second in the world; three rows count. */
	readonly #skin = new Float64Array(16);
	readonly #felt = new Float64Array(16);
	readonly #feltBefore = new Float64Array(16);
	readonly #rest = new Float64Array(16);
	readonly #vector = new Vector3();

	/**
	 * @param mesh shells' mesh; its own placement is the baked pose
	 * @param position positions of its vertices, three numbers each
	 * @param furLength longest fur as baked, the mesh's own units
	 * @param pace ω of the fur
	 */
	constructor(mesh: Object3D, position: Float32Array, furLength: number, pace: number) {
		this.#mesh = mesh;
		this.#bakedDown.copy(down).applyQuaternion(mesh.quaternion.clone().conjugate());
		const points = new BufferGeometry().setAttribute('position', new BufferAttribute(position, 3));
		points.computeBoundingSphere();
		this.sphere = points.boundingSphere ?? new Sphere();
		this.#furLength = furLength;
		this.#fastest = MAX_SPEED * pace;
	}

	/**
	 * Reads the body's present placement.
	 *
	 * @param seconds since the last call
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

	/** Find the placement; a singular one (a scale of 0, say) is ignored. */
	#find(): void {
		const { matrixWorld } = this.#mesh;
		this.#mesh.updateWorldMatrix(true, false);
		if (Math.abs(matrixWorld.determinant()) > 0) this.#to.copy(matrixWorld);
	}

	/** Forget all motion. */
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

	/** Measure the velocity in this frame, bounded. @returns false for a jump to another place */
	#measure(seconds: number): boolean {
		const { elements: to } = this.#to;
		const { elements: from } = this.#from;
		const unit = Math.hypot(to[0], to[1], to[2]) * this.#furLength;
		for (let i = 0; i < 16; i++) this.#skin[i] = ((to[i] as number) - (from[i] as number)) / (seconds * unit);
		const speed = this.#speed(this.#skin);
		// Jump: farther than its own size, or turned by more than a quarter.
		if (!(speed * seconds * this.#furLength < 2 * this.sphere.radius)) return false;
		for (let i = 0; i < 16; i++) this.#skin[i] = (this.#skin[i] as number) / (1 + speed / this.#fastest);
		return true;
	}

	/** Speed of the body's centre and of the turn about it, lengths of the fur per second. */
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

	/** Advance within the frame: hairs catch up with the skin's velocity. */
	advance(seconds: number): void {
		const kept = Math.exp(-seconds / LAG);
		for (let i = 0; i < 16; i++) {
			const skin = this.#skin[i] as number;
			this.#felt[i] = skin + kept * ((this.#felt[i] as number) - skin);
		}
	}

	/** Whether hairs have caught up; a negligible rest is dropped. */
	caughtUp(): boolean {
		for (let i = 0; i < 16; i++) this.#rest[i] = (this.#skin[i] as number) - (this.#felt[i] as number);
		if (this.#speed(this.#rest) > MIN_SPEED) return false;
		this.#felt.set(this.#skin);
		return true;
	}

	/**
	 * Writes sag and kick of a sub-step and ends it.
	 *
	 * @param share of the frame at the sub-step's end
	 * @param gravity over the baked one
	 */
	write(drive: Drive, share: number, gravity: number): void {
		const { elements: from } = this.#from;
		const { elements: to } = this.#to;
		const { elements: now } = this.#now;
		for (let i = 0; i < 16; i++) now[i] = (from[i] as number) + share * ((to[i] as number) - (from[i] as number));
		// Forces are taken at the sub-step's middle.
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

	/** Displacement of the longest tips by gravity, shares of the length; 0 in the baked pose. */
	sag(gravity: number): Vector3 {
		const sag = this.turn.toMesh(this.#vector.copy(down)).multiplyScalar(gravity).sub(this.#bakedDown);
		return sag.lengthSq() < 1e-12 ? sag.set(0, 0, 0) : sag.multiplyScalar(SAG);
	}
}
