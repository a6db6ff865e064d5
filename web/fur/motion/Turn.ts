import { type Matrix4, Vector3 } from 'three';

/** Orientation of a mesh in the world. */
export class Turn {
	readonly #x = new Vector3(1, 0, 0);
	readonly #y = new Vector3(0, 1, 0);
	readonly #z = new Vector3(0, 0, 1);

	/** Sets the mean of two nearby placements. */
	between({ elements: a }: Matrix4, { elements: b }: Matrix4): void {
		this.#x.set(a[0] + b[0], a[1] + b[1], a[2] + b[2]).normalize();
		this.#y.set(a[4] + b[4], a[5] + b[5], a[6] + b[6]).normalize();
		this.#z.set(a[8] + b[8], a[9] + b[9], a[10] + b[10]).normalize();
	}

	/** Rotates the vector in place from the world's axes to the mesh's. */
	toMesh(vector: Vector3): Vector3 {
		return vector.set(this.#x.dot(vector), this.#y.dot(vector), this.#z.dot(vector));
	}
}
