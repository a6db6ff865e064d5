import { Vector3 } from 'three';
import type { FurFollicles } from '../body/FurFollicles.ts';
import type { Morphs } from '../body/Morphs.ts';
import type { Drive } from './drive.ts';

/**
 * Motion of a body's skin by morph targets, as its hairs feel it: `BodyMotion` of their weights instead of joints.
 */
export class MorphMotion {
	readonly #morphs: Morphs;
	readonly #follicles: FurFollicles;
	readonly #influences: () => readonly number[];
	readonly #furLength: number;
	readonly #fastest: number;
	/** Longest way of each target, lengths of the fur. */
	readonly #reach: Float64Array;
	/** Present weights. */
	readonly #to: Float64Array;
	/** Velocities of the weights, 1/s. */
	readonly #skin: Float64Array;
	readonly #felt: Float64Array;
	readonly #feltBefore: Float64Array;
	readonly #changes: number[];
	readonly #way = new Vector3();

	/**
	 * @param influences weights of the targets
	 * @param furLength longest fur as baked, the mesh's own units
	 * @param fastest upper bound of the skin's velocity, lengths of the fur per second
	 */
	constructor(
		morphs: Morphs,
		follicles: FurFollicles,
		influences: () => readonly number[],
		furLength: number,
		fastest: number,
	) {
		this.#morphs = morphs;
		this.#follicles = follicles;
		this.#influences = influences;
		this.#furLength = furLength;
		this.#fastest = fastest;
		const { count } = morphs;
		const numbers = () => new Float64Array(count);
		[this.#reach, this.#to] = [numbers(), numbers()];
		[this.#skin, this.#felt, this.#feltBefore] = [numbers(), numbers(), numbers()];
		this.#changes = Array.from(this.#to);
		for (let target = 0; target < count; target++)
			for (const vertex of follicles.vertex)
				this.#reach[target] = Math.max(this.#reach[target] as number, morphs.reach(vertex, target) / furLength);
	}

	/** Reads the present weights. @param seconds since the last call @returns whether they have changed */
	look(seconds: number): boolean {
		const influences = this.#influences();
		let changed = false;
		for (let target = 0; target < this.#to.length; target++) {
			const weight = weightOf(influences, target);
			const speed = (weight - (this.#to[target] as number)) / seconds;
			changed ||= speed !== 0;
			this.#skin[target] = speed / (1 + (Math.abs(speed) * (this.#reach[target] as number)) / this.#fastest);
			this.#to[target] = weight;
		}
		return changed;
	}

	/** Forget all motion. */
	place(): void {
		const influences = this.#influences();
		for (let target = 0; target < this.#to.length; target++) this.#to[target] = weightOf(influences, target);
		for (const speeds of [this.#skin, this.#felt, this.#feltBefore]) speeds.fill(0);
	}

	/** Advance within the frame. @param kept share of the old velocity that hairs still feel */
	advance(kept: number): void {
		for (let target = 0; target < this.#skin.length; target++) {
			const skin = this.#skin[target] as number;
			this.#felt[target] = skin + kept * ((this.#felt[target] as number) - skin);
		}
	}

	/** Speed that hairs still have to catch up with, lengths of the fur per second. */
	get rest(): number {
		let rest = 0;
		for (let target = 0; target < this.#skin.length; target++) {
			const behind = (this.#skin[target] as number) - (this.#felt[target] as number);
			rest += Math.abs(behind) * (this.#reach[target] as number);
		}
		return rest;
	}

	/** Drops that rest. */
	catchUp(): void {
		this.#felt.set(this.#skin);
	}

	/** Adds the kicks of a sub-step and ends it. */
	write(drive: Drive): void {
		let changed = false;
		for (let target = 0; target < this.#felt.length; target++) {
			const felt = this.#felt[target] as number;
			const change = ((this.#feltBefore[target] as number) - felt) / this.#furLength;
			this.#changes[target] = change;
			this.#feltBefore[target] = felt;
			changed ||= change !== 0;
		}
		drive.morphs = changed;
		if (!changed) return;
		drive.kicks = true;
		const { vertex } = this.#follicles;
		for (let i = 0; i < vertex.length; i++) {
			this.#morphs.addTo(this.#way.set(0, 0, 0), vertex[i] as number, this.#changes);
			this.#way.toArray(drive.ways, 4 * i);
		}
	}
}

/** Weight of a target; one that is not finite is none. */
function weightOf(influences: readonly number[], target: number): number {
	const weight = influences[target] ?? 0;
	return Number.isFinite(weight) ? weight : 0;
}
