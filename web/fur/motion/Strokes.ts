import { type Matrix4, Vector3 } from 'three';
import { FOLLICLES_PER_ROW, type Follicles } from '../follicles.ts';
import { LIMIT, STEP } from './spring.ts';

/** How far a finger lays hairs, share of their length: farther than they go, so that a lane stays a while before it fades. */
const LAY = 1.6;
/** How far aside it sweeps those at its rim, sine of the angle to its way: there the fur is parted. */
const PART = 0.85;
/** A hair in the middle of a lane is laid but for e^(−4/3·FIRMNESS) when the finger has passed. */
const FIRMNESS = 2.2;
/** Strokes at a time that have not come to their end; the oldest of more is there at once. */
const MOST = 64;
/** Numbers of one: from, to, radius, 1 where its frame is over. */
const STRIDE = 8;
/** Of what is less the springs take hairs back by themselves, and nobody sees it. */
const NOTHING = 0.02;
/** When the common factor is smaller, offsets are multiplied by it. */
const SMALL = 0.1;

/**
 * The lanes that fingers leave: of each follicle the offset of its spring's rest, which fades over seconds.
 *
 * A stroke takes as long as the frame in which it is reported, so that the same finger lays the same lane at any frame rate:
 * what it does to a hair grows with the way that it goes near it, however that is cut into strokes.
 */
export class Strokes {
	/** A texel each, RGBA: the offset, before it is multiplied by `fade`. */
	readonly offsets: Float32Array;
	/** Grows whenever offsets change otherwise than by fading. */
	version = 0;
	readonly #follicles: Follicles;
	readonly #kept: number;
	readonly #pending = new Float64Array(MOST * STRIDE);
	#count = 0;
	#fade = 1;
	#widest = 0;
	readonly #point = new Vector3();

	/** @param relaxation seconds in which all but 1/e of a lane is gone */
	constructor(follicles: Follicles, relaxation: number) {
		this.#follicles = follicles;
		this.#kept = Math.exp(-STEP / relaxation);
		this.offsets = new Float32Array(4 * FOLLICLES_PER_ROW * Math.ceil(follicles.count / FOLLICLES_PER_ROW));
	}

	/** What all offsets are to be multiplied by. */
	get fade(): number {
		return this.#fade;
	}

	/** An upper bound of the offsets, shares of the length; 0 without any. */
	get widest(): number {
		return this.#widest;
	}

	/** Whether fingers have still something to do. */
	get pending(): boolean {
		return this.#count > 0;
	}

	/**
	 * A finger goes straight on from one point to another during the next frame.
	 *
	 * @param meshFromWorld into the axes in which it stays where it is if the body moves
	 * @param radius in the mesh's units
	 */
	add(from: Vector3, to: Vector3, meshFromWorld: Matrix4, radius: number): void {
		if (this.#count === MOST) {
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
	 * Fingers go on, and lanes fade, by a sub-step.
	 *
	 * @param before share of the frame that was over when fingers went on last
	 * @param now share of the frame that is over
	 */
	advance(before: number, now: number): void {
		this.#fade *= this.#kept;
		this.#widest *= this.#kept;
		if (this.#widest > 0 && this.#widest < NOTHING) this.#clear();
		const part = before < 1 ? Math.min((now - before) / (1 - before), 1) : 1;
		for (let stroke = 0; stroke < this.#count; stroke++)
			this.#lay(stroke, this.#pending[stroke * STRIDE + 7] === 1 ? 1 : part);
		this.#sweep();
	}

	/** What has not been done by now is overdue. */
	endFrame(): void {
		for (let stroke = 0; stroke < this.#count; stroke++) this.#pending[stroke * STRIDE + 7] = 1;
	}

	/** All that is pending is done at once. */
	finish(): void {
		for (let stroke = 0; stroke < this.#count; stroke++) this.#lay(stroke, 1);
		this.#count = 0;
	}

	/** No fingers, no lanes. */
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

	/** Removes those that are done. */
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

	/** A finger does this part of what it has still to do. */
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
		if (this.#fade < SMALL) this.#fold();
		const radius = pending[at + 6] as number;
		const { count, position, normal, comb } = this.#follicles;
		for (let i = 0; i < count; i++) {
			const px = (position[3 * i] as number) - x;
			const py = (position[3 * i + 1] as number) - y;
			const pz = (position[3 * i + 2] as number) - z;
			const there = px * along + py * up + pz * beside;
			const near = radius * radius - (px * px + py * py + pz * pz - there * there);
			if (near <= 0) continue;
			// Where the finger's path is within its radius of the hair, from where it is nearest.
			const reach = Math.sqrt(near);
			const first = Math.max(-there, -reach);
			const last = Math.min(way - there, reach);
			if (last <= first) continue;
			// ∫ (1 − distance²/radius²) along it, in radii.
			const felt = (near * (last - first) - (last ** 3 - first ** 3) / 3) / radius ** 3;
			const nx = normal[3 * i] as number;
			const ny = normal[3 * i + 1] as number;
			const nz = normal[3 * i + 2] as number;
			// Along its way in the middle, aside at its rim.
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

	/** Fades the offsets themselves. */
	#fold(): void {
		for (let i = 0; i < this.offsets.length; i++) this.offsets[i] = (this.offsets[i] as number) * this.#fade;
		this.#fade = 1;
	}
}
