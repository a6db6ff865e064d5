import type { Joints } from '../body/joints/joints.ts';
import { type Drive, JOINT } from './drive.ts';

/** Most steps towards a rotation: enough for joints bent to a right angle. */
export const STEPS = 3;
/** Squared difference from a rotation that counts as none. */
const STRAIGHT = 1e-10;

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
		const a = weights[at] as number;
		const b = weights[at + 1] as number;
		const c = weights[at + 2] as number;
		const d = weights[at + 3] as number;
		const p = JOINT * (joints[at] as number);
		const q = JOINT * (joints[at + 1] as number);
		const r = JOINT * (joints[at + 2] as number);
		const s = JOINT * (joints[at + 3] as number);
		for (let i = 0; i < count; i++) place[i] = a * (numbers[p + i] as number) + b * (numbers[q + i] as number);
		if (c === 0 && d === 0) return;
		for (let i = 0; i < count; i++)
			place[i] = (place[i] as number) + c * (numbers[r + i] as number) + d * (numbers[s + i] as number);
	}

	/**
	 * Find the rotation next to the mixed matrix, scaled, by Newton and Schulz's steps X' = (3 − X·Xᵀ)·X / 2. Where a body is
	 * folded flat, forces across the fold are lost.
	 */
	#straighten(): void {
		const m = this.place;
		let ax = m[0] as number;
		let ay = m[4] as number;
		let az = m[8] as number;
		let bx = m[1] as number;
		let by = m[5] as number;
		let bz = m[9] as number;
		let cx = m[2] as number;
		let cy = m[6] as number;
		let cz = m[10] as number;
		const square = ax * ax + ay * ay + az * az + bx * bx + by * by + bz * bz + cx * cx + cy * cy + cz * cz;
		// The squares sum to 3 then.
		const scale = square > 0 ? Math.sqrt(3 / square) : 0;
		ax *= scale;
		ay *= scale;
		az *= scale;
		bx *= scale;
		by *= scale;
		bz *= scale;
		cx *= scale;
		cy *= scale;
		cz *= scale;
		for (let step = 0; step < STEPS; step++) {
			const ab = 0.5 * (ax * bx + ay * by + az * bz);
			const ac = 0.5 * (ax * cx + ay * cy + az * cz);
			const bc = 0.5 * (bx * cx + by * cy + bz * cz);
			const aa = 0.5 - 0.5 * (ax * ax + ay * ay + az * az);
			const bb = 0.5 - 0.5 * (bx * bx + by * by + bz * bz);
			const cc = 0.5 - 0.5 * (cx * cx + cy * cy + cz * cz);
			if (ab * ab + ac * ac + bc * bc + aa * aa + bb * bb + cc * cc < STRAIGHT) break;
			const px = ax;
			const py = ay;
			const pz = az;
			ax += aa * px - ab * bx - ac * cx;
			ay += aa * py - ab * by - ac * cy;
			az += aa * pz - ab * bz - ac * cz;
			const qx = bx;
			const qy = by;
			const qz = bz;
			bx += bb * qx - ab * px - bc * cx;
			by += bb * qy - ab * py - bc * cy;
			bz += bb * qz - ab * pz - bc * cz;
			cx += cc * cx - ac * px - bc * qx;
			cy += cc * cy - ac * py - bc * qy;
			cz += cc * cz - ac * pz - bc * qz;
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
