import type { Joints } from '../body/joints.ts';
import { type Drive, JOINT } from './drive.ts';

/** Steps towards a rotation: enough for joints bent to a right angle. */
export const STEPS = 3;

/**
 * Forces of a drive on follicles of the same joints and weights, brought to the rest axes of the shells' mesh;
 * springs.frag.glsl does the same.
 *
 * Shaders turn a hair with the frame of the posed skin; what is next to it of a follicle without tangents is the rotation
 * next to its blended matrix.
 */
export class Blend {
	/** Displacement of the longest tips by gravity alone, beyond that in the comb. */
	readonly sag = new Float64Array(3);
	/** Unit vector along the wind. */
	readonly blow = new Float64Array(3);
	/** Rows of the matrix (position, 1) → velocity added to the tips by the skin's motion, 1/s. */
	readonly kick = new Float64Array(12);
	/** First rows of the matrix (position, 1) → place, in radii about the body's centre, world axes; then velocities. */
	readonly place = new Float64Array(JOINT);
	readonly #joints: Joints;
	/** Rows of the rotation from the world's axes to those at rest. */
	readonly #turn = new Float64Array(9);

	constructor(joints: Joints) {
		this.#joints = joints;
	}

	/** Sets the forces to those on a run of follicles. */
	set({ pull, laid, sags, blow, joints, kicks }: Drive, run: number): void {
		this.#mix(joints, 4 * run, kicks ? JOINT : 12);
		this.#straighten();
		const { place, sag, kick } = this;
		const turn = this.#turn;
		for (let row = 0; row < 3; row++) {
			const x = turn[3 * row] as number;
			const y = turn[3 * row + 1] as number;
			const z = turn[3 * row + 2] as number;
			sag[row] = sags
				? x * (pull[0] as number) + y * (pull[1] as number) + z * (pull[2] as number) - (laid[row] as number)
				: 0;
			this.blow[row] = x * (blow[0] as number) + y * (blow[1] as number) + z * (blow[2] as number);
			if (!kicks) continue;
			for (let i = 12; i < 16; i++)
				kick[4 * row + i - 12] = x * (place[i] as number) + y * (place[i + 4] as number) + z * (place[i + 8] as number);
		}
	}

	/** Mean of the first numbers of the four joints. */
	#mix(numbers: Float32Array, at: number, count: number): void {
		const { place } = this;
		const { joints, weights } = this.#joints;
		place.fill(0);
		for (let c = at; c < at + 4; c++) {
			const weight = weights[c] as number;
			if (weight === 0) continue;
			const from = JOINT * (joints[c] as number);
			for (let i = 0; i < count; i++) place[i] = (place[i] as number) + weight * (numbers[from + i] as number);
		}
	}

	/**
	 * Find the rotation next to the mixed matrix, scaled, by Newton and Schulz's steps X' = (3 − X·Xᵀ)·X / 2. Where a body is
	 * folded flat, forces across the fold are lost.
	 */
	#straighten(): void {
		const m = this.place;
		let [ax, ay, az] = [m[0] as number, m[4] as number, m[8] as number];
		let [bx, by, bz] = [m[1] as number, m[5] as number, m[9] as number];
		let [cx, cy, cz] = [m[2] as number, m[6] as number, m[10] as number];
		let aa = ax * ax + ay * ay + az * az;
		let bb = bx * bx + by * by + bz * bz;
		let cc = cx * cx + cy * cy + cz * cz;
		const square = aa + bb + cc;
		// Squares of the lengths sum to 3.
		let scale = square > 0 ? Math.sqrt(3 / square) : 0;
		for (let step = 0; step < STEPS; step++) {
			const s = 0.5 * scale ** 2;
			const ab = s * (ax * bx + ay * by + az * bz);
			const ac = s * (ax * cx + ay * cy + az * cz);
			const bc = s * (bx * cx + by * cy + bz * cz);
			const [a, b, c] = [1.5 - s * aa, 1.5 - s * bb, 1.5 - s * cc];
			const [px, py, pz] = [ax, ay, az];
			const [qx, qy, qz] = [bx, by, bz];
			ax = scale * (a * px - ab * qx - ac * cx);
			ay = scale * (a * py - ab * qy - ac * cy);
			az = scale * (a * pz - ab * qz - ac * cz);
			bx = scale * (b * qx - ab * px - bc * cx);
			by = scale * (b * qy - ab * py - bc * cy);
			bz = scale * (b * qz - ab * pz - bc * cz);
			cx = scale * (c * cx - ac * px - bc * qx);
			cy = scale * (c * cy - ac * py - bc * qy);
			cz = scale * (c * cz - ac * pz - bc * qz);
			aa = ax * ax + ay * ay + az * az;
			bb = bx * bx + by * by + bz * bz;
			cc = cx * cx + cy * cy + cz * cz;
			scale = 1;
		}
		const turn = this.#turn;
		turn[0] = ax;
		turn[1] = ay;
		turn[2] = az;
		turn[3] = bx;
		turn[4] = by;
		turn[5] = bz;
		turn[6] = cx;
		turn[7] = cy;
		turn[8] = cz;
	}
}
