import { InstancedBufferAttribute } from 'three';

/** Where the bodies of one draw stand: a matrix for each, rewritten and uploaded only where one is another than before. */
export class Places extends InstancedBufferAttribute {
	readonly #bodies: Uint32Array;
	#count = 0;
	/** `addUpdateRange` would make a new one each time. */
	readonly #range = { start: 0, count: 0 };

	/**
	 * @param capacity most bodies that there can be
	 * @param instances of each body, one after the other
	 */
	constructor(capacity: number, instances = 1) {
		super(new Float32Array(capacity * 16), 16, false, instances);
		this.#bodies = new Uint32Array(capacity);
	}

	/**
	 * Takes `count` bodies: drawn[first], drawn[first + step] and so on.
	 *
	 * @param matrices of all bodies, column-major
	 * @param moved whether these are others than before
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
