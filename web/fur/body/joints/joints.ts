/** Joints that carry follicles: the bones of a skeleton, or the one node of a body without. */

import { Sphere, Vector3 } from 'three';
import type { FurFollicles } from '../FurFollicles.ts';

/** Weight from which a follicle counts to the sphere of its joint. */
const HEAVY = 1 / 8;

/** Joints of a body's follicles. */
export interface Joints {
	/** Bone of each, number in the skeleton; bones that carry nothing are left out. */
	readonly bones: Uint16Array;
	/** Share of the body that each carries. */
	readonly shares: Float64Array;
	/** Bounding sphere of what each carries, the mesh's units. */
	readonly spheres: readonly Sphere[];
	/** First follicle of each run of follicles with the same joints and weights, and the end of the last. */
	readonly first: Uint32Array;
	/** Four joints of each run. */
	readonly joints: Uint16Array;
	/** Weight of each of the four. */
	readonly weights: Float32Array;
}

/** Joints by their follicles, which motions of one body share. */
const known = new WeakMap<FurFollicles, Joints>();

/** Joints of a body's follicles: a body without a skeleton has one joint and one run. */
export function jointsOf(follicles: FurFollicles): Joints {
	const joints = known.get(follicles) ?? find(follicles);
	known.set(follicles, joints);
	return joints;
}

function find({ count, position, bones, boneWeights }: FurFollicles): Joints {
	const [numbers, weights] = bones && boneWeights ? [bones, boneWeights] : [new Uint16Array(4), Float32Array.of(1)];
	// All follicles of a body without a skeleton are as the first.
	const at = (i: number) => (bones ? 4 * i : 0);
	const starts: number[] = [];
	for (let i = 0; i < count; i++) if (i === 0 || differ(numbers, weights, at(i), at(i - 1))) starts.push(i);
	const used = new Map<number, number>();
	const carried: { total: number; points: Vector3[]; heavy: Vector3[] }[] = [];
	const joints = new Uint16Array(4 * starts.length);
	const shares = new Float32Array(4 * starts.length);
	for (const [run, start] of starts.entries()) {
		for (let c = 0; c < 4; c++) {
			const weight = weights[at(start) + c] as number;
			if (!(weight > 0)) continue;
			const bone = numbers[at(start) + c] as number;
			const joint = used.get(bone) ?? used.size;
			if (joint === used.size) {
				used.set(bone, joint);
				carried.push({ total: 0, points: [], heavy: [] });
			}
			joints[4 * run + c] = joint;
			shares[4 * run + c] = weight;
			const { points, heavy } = carried[joint] as (typeof carried)[number];
			for (let i = start; i < (starts[run + 1] ?? count); i++) {
				(carried[joint] as (typeof carried)[number]).total += weight;
				(weight < HEAVY ? points : heavy).push(new Vector3().fromArray(position, 3 * i));
			}
		}
	}
	const whole = carried.reduce((sum, { total }) => sum + total, 0);
	return {
		bones: Uint16Array.from(used.keys()),
		shares: Float64Array.from(carried, ({ total }) => total / whole),
		spheres: carried.map(({ points, heavy }) => new Sphere().setFromPoints(heavy.length > 0 ? heavy : points)),
		first: Uint32Array.from([...starts, count]),
		joints,
		weights: shares,
	};
}

function differ(numbers: Uint16Array, weights: Float32Array, a: number, b: number): boolean {
	for (let c = 0; c < 4; c++) if (numbers[a + c] !== numbers[b + c] || weights[a + c] !== weights[b + c]) return true;
	return false;
}
