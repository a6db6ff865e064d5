import { type Matrix4, Vector3 } from 'three';
import { FOLLICLES_PER_ROW, type FurFollicles } from '../body/FurFollicles.ts';
import { LIMIT, STEP } from './spring.ts';

/** Displacement by a finger, share of the length: beyond the limit, so that a lane stays a while before it fades. */
const LAY = 1.6;
/** Sideways sweep at the finger's rim, sine of the angle to its path: parts the fur there. */
const PART = 0.85;
/** Firmness of a finger: e^(−4/3·FIRMNESS) of the way is left for a hair in the middle of a lane. */
const FIRMNESS = 2.2;
/** Most pending strokes; the oldest of more is finished at once. */
const MAX_STROKES = 64;
/** Numbers per stroke: from, to, radius, 1 if its frame is over. */
const STRIDE = 8;
/** Offset below which hairs spring back unnoticed. */
const MIN_OFFSET = 0.02;
/** Common factor below which it is multiplied into the offsets. */
const MIN_FADE = 0.1;

/**
 * Lanes left by fingers: an offset of each follicle's rest, which fades over seconds.
 *
 * A stroke lasts as long as the frame that reports it, and its effect on a hair grows with the length of its path near it.
 * So the same finger lays the same lane at any frame rate.
 */
export class Strokes {
	/** Offsets before the factor `fade`, an RGBA texel each. */
	readonly offsets: Float32Array;
	/** Incremented when offsets change other than by fading. */
	version = 0;
	readonly #follicles: FurFollicles;
	readonly #kept: number;
	readonly #pending = new Float64Array(MAX_STROKES * STRIDE);
	#count = 0;
	#fade = 1;
	#widest = 0;
	readonly #point = new Vector3();

	/** @param relaxation seconds until 1/e of a lane is left */
	constructor(follicles: FurFollicles, relaxation: number) {
		this.#follicles = follicles;
		this.#kept = Math.exp(-STEP / relaxation);
		this.offsets = new Float32Array(4 * FOLLICLES_PER_ROW * Math.ceil(follicles.count / FOLLICLES_PER_ROW));
	}

	/** Common factor of all offsets. */
	get fade(): number {
		return this.#fade;
	}

	/** Upper bound of the offsets, shares of the length; 0 without any. */
	get widest(): number {
		return this.#widest;
	}

	/** Whether strokes are pending. */
	get pending(): boolean {
		return this.#count > 0;
	}

	/**
	 * Adds a straight stroke during the next frame.
	 *
	 * @param meshFromWorld world axes → the mesh's, in which the stroke is fixed
	 * @param radius in the mesh's units
	 */
	add(from: Vector3, to: Vector3, meshFromWorld: Matrix4, radius: number): void {
		if (this.#count === MAX_STROKES) {
			this.#lay(0, 1);
			this.#remove(0);
		}
		const at = this.#count * STRIDE;
		this.#point.copy(from).applyMatrix4(meshFromWorld).toArray(this.#pending, at);
		this.#point
			.copy(to)
			.applyMatrix4(meshFromWorld)
			.toArray(this.#pending, at + 3);
		this.#pending[at + 6] = radius;
		this.#pending[at + 7] = 0;
		this.#count++;
	}

	/**
	 * Advances strokes and fades lanes by a sub-step.
	 *
	 * @param before share of the frame at the last sub-step
	 * @param now share of the frame at this one
	 */
	advance(before: number, now: number): void {
		this.#fade *= this.#kept;
		this.#widest *= this.#kept;
		if (this.#widest > 0 && this.#widest < MIN_OFFSET) this.#clear();
		const part = before < 1 ? Math.min((now - before) / (1 - before), 1) : 1;
		for (let stroke = 0; stroke < this.#count; stroke++)
			this.#lay(stroke, this.#pending[stroke * STRIDE + 7] === 1 ? 1 : part);
		this.#sweep();
	}

	/** Mark pending strokes as overdue. */
	endFrame(): void {
		for (let stroke = 0; stroke < this.#count; stroke++) this.#pending[stroke * STRIDE + 7] = 1;
	}

	/** Finishes pending strokes at once. */
	finish(): void {
		for (let stroke = 0; stroke < this.#count; stroke++) this.#lay(stroke, 1);
		this.#count = 0;
	}

	/** Removes all strokes and lanes. */
	reset(): void {
		this.#count = 0;
		this.#clear();
	}

	#clear(): void {
		if (this.#widest > 0) this.offsets.fill(0);
		this.version++;
		this.#fade = 1;
		this.#widest = 0;
	}

	/** Remove finished strokes. */
	#sweep(): void {
		const pending = this.#pending;
		for (let stroke = this.#count - 1; stroke >= 0; stroke--) {
			const at = stroke * STRIDE;
			let left = 0;
			for (let i = at; i < at + 3; i++) left += Math.abs((pending[i + 3] as number) - (pending[i] as number));
			if (left === 0) this.#remove(stroke);
		}
	}

	#remove(stroke: number): void {
		this.#pending.copyWithin(stroke * STRIDE, (stroke + 1) * STRIDE, this.#count * STRIDE);
		this.#count--;
	}

	/** Apply this part of the rest of a stroke. */
	#lay(stroke: number, part: number): void {
		const pending = this.#pending;
		const at = stroke * STRIDE;
		const [x, y, z] = [pending[at] as number, pending[at + 1] as number, pending[at + 2] as number];
		for (let i = at; i < at + 3; i++) {
			const [from, to] = [pending[i] as number, pending[i + 3] as number];
			pending[i] = part < 1 ? from + part * (to - from) : to;
		}
		let along = (pending[at] as number) - x;
		let up = (pending[at + 1] as number) - y;
		let beside = (pending[at + 2] as number) - z;
		const way = Math.hypot(along, up, beside);
		if (!(way > 0)) return;
		along /= way;
		up /= way;
		beside /= way;
		if (this.#fade < MIN_FADE) this.#fold();
		const radius = pending[at + 6] as number;
		const { count, position, normal, comb } = this.#follicles;
		for (let i = 0; i < count; i++) {
			const px = (position[3 * i] as number) - x;
			const py = (position[3 * i + 1] as number) - y;
			const pz = (position[3 * i + 2] as number) - z;
			const there = px * along + py * up + pz * beside;
			const near = radius * radius - (px * px + py * py + pz * pz - there * there);
			if (near <= 0) continue;
			// Half the path within the finger's radius of the hair, around the nearest point.
			const reach = Math.sqrt(near);
			const first = Math.max(-there, -reach);
			const last = Math.min(way - there, reach);
			if (last <= first) continue;
			// ∫ (1 − distance²/radius²) along it, in radii.
			const felt = (near * (last - first) - (last ** 3 - first ** 3) / 3) / radius ** 3;
			const nx = normal[3 * i] as number;
			const ny = normal[3 * i + 1] as number;
			const nz = normal[3 * i + 2] as number;
			// Along the path in the middle, aside at the rim.
			const aside = PART / radius;
			const ahead = Math.sqrt(1 - PART * PART * (1 - near / (radius * radius))) - aside * there;
			const wayX = ahead * along + aside * px;
			const wayY = ahead * up + aside * py;
			const wayZ = ahead * beside + aside * pz;
			const outward = wayX * nx + wayY * ny + wayZ * nz;
			const share = Math.sqrt(Math.max(1 - outward * outward, 0));
			if (share < 1e-3) continue;
			const laid = 1 - Math.exp(-FIRMNESS * share * felt);
			this.#pull(4 * i, laid, (LAY * (wayX - outward * nx)) / share - (comb[3 * i] as number));
			this.#pull(4 * i + 1, laid, (LAY * (wayY - outward * ny)) / share - (comb[3 * i + 1] as number));
			this.#pull(4 * i + 2, laid, (LAY * (wayZ - outward * nz)) / share - (comb[3 * i + 2] as number));
		}
		this.#widest = LAY + LIMIT;
		this.version++;
	}

	#pull(at: number, share: number, towards: number): void {
		const offset = this.offsets[at] as number;
		this.offsets[at] = offset + share * (towards / this.#fade - offset);
	}

	/** Multiply the factor into the offsets. */
	#fold(): void {
		for (let i = 0; i < this.offsets.length; i++) this.offsets[i] = (this.offsets[i] as number) * this.#fade;
		this.#fade = 1;
	}
}
