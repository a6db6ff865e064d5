import { Matrix4, type Object3D, type Vector3 } from 'three';
import type { FurFollicles } from './FurFollicles.ts';
import { type Joints, jointsOf } from './joints.ts';
import { Placements } from './Placements.ts';

/** Body where it stands, for fingers and rain: which follicle is at a place in the world. */
export class PosedBody {
	/** World → rest in the mesh's axes, around the follicle found last. */
	readonly restFromWorld = new Matrix4();
	readonly #follicles: FurFollicles;
	readonly #joints: Joints;
	readonly #placements: Placements;
	readonly #matrices: Float64Array;
	readonly #blend = new Matrix4();

	/** @param mesh shells' mesh */
	constructor(mesh: Object3D, follicles: FurFollicles) {
		this.#follicles = follicles;
		this.#joints = jointsOf(follicles);
		this.#placements = new Placements(mesh, this.#joints);
		this.#matrices = new Float64Array(16 * this.#joints.bones.length);
	}

	/** Finds the follicle nearest to a point of the world, and sets `restFromWorld`. */
	find({ x, y, z }: Vector3): number {
		this.#placements.read(this.#matrices);
		const { position, count } = this.#follicles;
		const { first } = this.#joints;
		const { elements: m } = this.#blend;
		let [nearest, best, closest] = [0, 0, Number.POSITIVE_INFINITY];
		for (let i = 0, at = 0, run = 0; i < count; i++, at += 3) {
			if (i === first[run]) this.#mix(run++);
			const px = position[at] as number;
			const py = position[at + 1] as number;
			const pz = position[at + 2] as number;
			const away =
				(m[0] * px + m[4] * py + m[8] * pz + m[12] - x) ** 2 +
				(m[1] * px + m[5] * py + m[9] * pz + m[13] - y) ** 2 +
				(m[2] * px + m[6] * py + m[10] * pz + m[14] - z) ** 2;
			if (away >= closest) continue;
			nearest = i;
			closest = away;
			best = run - 1;
		}
		this.#mix(best);
		this.restFromWorld.copy(this.#blend).invert();
		return nearest;
	}

	/** Mean placement of a run's joints. */
	#mix(run: number): void {
		const { joints, weights } = this.#joints;
		const { elements } = this.#blend;
		elements.fill(0);
		for (let c = 4 * run; c < 4 * run + 4; c++) {
			const weight = weights[c] as number;
			const from = 16 * (joints[c] as number);
			for (let i = 0; weight > 0 && i < 16; i++)
				elements[i] = (elements[i] as number) + weight * (this.#matrices[from + i] as number);
		}
	}
}
