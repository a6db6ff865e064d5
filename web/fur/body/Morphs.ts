/** Morph targets of a geometry, for its vertices on the GPU. */

import {
	type BufferAttribute,
	type BufferGeometry,
	DataArrayTexture,
	type InterleavedBufferAttribute,
	RGBAIntegerFormat,
	ShortType,
	type Vector3,
} from 'three';

/** Vertices in a row of texels; as in pose.glsl. */
const VERTICES_PER_ROW = 512;
/** Largest number stored. */
const MAX_SHORT = 32767;
/** Change of a unit vector stored as 1; as in pose.glsl. */
const TURN = 2 / MAX_SHORT;
/** Attributes that targets change, a texel each. */
const PARTS = ['position', 'normal', 'tangent'] as const;

type Attribute = BufferAttribute | InterleavedBufferAttribute;

const known = new WeakMap<Attribute, Morphs>();

/** Changes of position, normal and tangent of every vertex by each target. */
export class Morphs {
	/** A layer per target, a texel per vertex and attribute: 16-bit integers. */
	readonly texture: DataArrayTexture;
	/** Number of targets. */
	readonly count: number;
	/** Change of a position stored as 1, the mesh's own units. */
	readonly unit: number;
	readonly #shorts: Int16Array;
	readonly #each: number;

	/**
	 * Targets of a geometry, which loses its `morphAttributes`: three would make a texture of its own for them. Geometries that
	 * share their positions share the targets.
	 *
	 * @returns undefined without targets
	 */
	static of(geometry: BufferGeometry): Morphs | undefined {
		const { morphAttributes } = geometry;
		const position = geometry.getAttribute('position');
		if (morphAttributes.position?.length) {
			known.set(position, new Morphs(position.count, morphAttributes));
			geometry.morphAttributes = {};
		}
		return known.get(position);
	}

	private constructor(vertices: number, targets: Record<string, Attribute[] | undefined>) {
		const positions = targets.position ?? [];
		this.count = positions.length;
		let largest = 0;
		for (const position of positions)
			for (let i = 0; i < vertices; i++)
				for (let c = 0; c < 3; c++) largest = Math.max(largest, Math.abs(position.getComponent(i, c)));
		this.unit = largest / MAX_SHORT;
		const rows = Math.ceil(vertices / VERTICES_PER_ROW);
		this.#each = 12 * VERTICES_PER_ROW * rows;
		this.#shorts = new Int16Array(this.#each * this.count);
		for (const [part, name] of PARTS.entries()) {
			const unit = (part === 0 ? this.unit : TURN) || 1;
			for (const [target, changes] of (targets[name] ?? []).entries()) {
				for (let i = 0; i < vertices; i++)
					for (let c = 0; c < 3; c++) {
						const steps = Math.round(changes.getComponent(i, c) / unit);
						this.#shorts[this.#each * target + 12 * i + 4 * part + c] = Math.min(
							Math.max(steps, -MAX_SHORT),
							MAX_SHORT,
						);
					}
			}
		}
		this.texture = new DataArrayTexture(this.#shorts, 3 * VERTICES_PER_ROW, rows, this.count);
		this.texture.name = 'morph targets';
		this.texture.format = RGBAIntegerFormat;
		this.texture.type = ShortType;
		this.texture.needsUpdate = true;
	}

	/** Adds the targets' changes to the position of a vertex. */
	addTo(position: Vector3, vertex: number, influences: readonly number[]): void {
		for (let target = 0; target < this.count; target++) {
			const weight = (influences[target] ?? 0) * this.unit;
			if (weight === 0) continue;
			const at = this.#each * target + 12 * vertex;
			position.x += weight * (this.#shorts[at] as number);
			position.y += weight * (this.#shorts[at + 1] as number);
			position.z += weight * (this.#shorts[at + 2] as number);
		}
	}

	/** Length of a target's change of a vertex's position. */
	reach(vertex: number, target: number): number {
		const at = this.#each * target + 12 * vertex;
		const [x, y, z] = this.#shorts.subarray(at, at + 3) as unknown as [number, number, number];
		return Math.hypot(x, y, z) * this.unit;
	}
}

/** Most targets in use at a time; of more, those of the largest weights count. */
export const MAX_MORPHS = 64;

/** Uniforms of pose.glsl that a body's furs share. */
export class MorphWeights {
	readonly uniforms = { morphCount: { value: 0 }, morphs: { value: new Float32Array(4) } };
	readonly #order: number[] = [];

	/** Number of weights that fit. @param targets of the body */
	static slots(targets: number): number {
		return Math.min(targets, MAX_MORPHS);
	}

	/** Writes the targets in use. */
	write(influences: readonly number[], targets: number): void {
		const slots = MorphWeights.slots(targets);
		const { morphCount, morphs } = this.uniforms;
		const length = 4 * Math.ceil(slots / 2);
		if (morphs.value.length !== length) morphs.value = new Float32Array(length);
		const order = this.#order;
		order.length = 0;
		for (let target = 0; target < targets; target++) if (influences[target]) order.push(target);
		if (order.length > slots) {
			const strength = (target: number) => Math.abs(influences[target] as number);
			order.sort((a, b) => strength(b) - strength(a)).length = slots;
		}
		morphCount.value = order.length;
		for (let i = 0; i < order.length; i++) {
			morphs.value[2 * i] = order[i] as number;
			morphs.value[2 * i + 1] = influences[order[i] as number] as number;
		}
	}
}
