import { InstancedBufferAttribute } from 'three';

/** Matrices of the bodies of one draw; only changes are written and uploaded. */
export class Places extends InstancedBufferAttribute {
	readonly #bodies: Uint32Array;
	#count = 0;
	/** `addUpdateRange` would make a new one each time. */
	readonly #range = { start: 0, count: 0 };

	/**
	 * @param capacity largest number of bodies
	 * @param instances instances per body, one after the other
	 */
	constructor(capacity: number, instances = 1) {
		super(new Float32Array(capacity * 16), 16, false, instances);
		this.#bodies = new Uint32Array(capacity);
	}

	/**
	 * Writes `count` bodies: drawn[first], drawn[first + step] and so on.
	 *
	 * @param matrices matrices of all bodies, column-major
	 * @param moved whether these have changed
	 */
	put(drawn: Uint32Array, first: number, step: number, count: number, matrices: Float32Array, moved: boolean): void {
		let same = !moved && count <= this.#count;
		for (let i = 0; i < count && same; i++) same = this.#bodies[i] === drawn[first + step * i];
		this.#count = count;
		if (same) return;
		for (let i = 0; i < count; i++) {
			const body = drawn[first + step * i] as number;
			this.#bodies[i] = body;
			for (let e = 0; e < 16; e++) this.array[16 * i + e] = matrices[16 * body + e] as number;
		}
		this.#range.count = 16 * count;
		this.updateRanges[0] = this.#range;
		this.needsUpdate = true;
	}
}
