import { DataTexture, FloatType, RGBAFormat } from 'three';
import { FOLLICLES_PER_ROW } from '../follicles.ts';
import { type Drive, GUST, LEE, STRENGTHS, VEER } from './drive.ts';
import type { Roots } from './roots.ts';
import type { Strokes } from './Strokes.ts';
import { type Solver, STATE, type States } from './solver.ts';
import { LIMIT, type Spring } from './spring.ts';

/**
 * A damped spring for every follicle, on the CPU.
 *
 * A sub-step is: what neighbours give each other; the spring's exact step about where the forces lead; the limit. The first
 * takes displacement and velocity towards the neighbours' by symmetric weights and back into the tangent plane. Its matrix
 * P(1 − L)P, with P an orthogonal projection and 0 ≤ L < 1, lengthens no vector, so energy does not grow by it; nor does it
 * by the damped spring, nor by the limit, the nearest point of a convex set that has the rest inside. And since it does the
 * same to displacement and velocity, it commutes with springs that are all alike.
 */
export class CpuSprings implements Solver, States {
	readonly swing: DataTexture;
	readonly #roots: Roots;
	readonly #spring: Spring;
	readonly #strokes: Strokes;
	readonly #texels: Float32Array;
	/** Where the forces lead, three numbers each. */
	readonly #lead: Float32Array;
	/** States at the beginning and at the end of the last sub-step. */
	#before: Float32Array;
	#after: Float32Array;

	constructor(roots: Roots, spring: Spring, strokes: Strokes) {
		const { count } = roots.follicles;
		const rows = Math.ceil(count / FOLLICLES_PER_ROW);
		this.#roots = roots;
		this.#spring = spring;
		this.#strokes = strokes;
		this.#lead = new Float32Array(3 * count);
		this.#before = new Float32Array(STATE * count);
		this.#after = new Float32Array(STATE * count);
		this.#texels = new Float32Array(4 * FOLLICLES_PER_ROW * rows);
		this.swing = new DataTexture(this.#texels, FOLLICLES_PER_ROW, rows, RGBAFormat, FloatType);
		this.swing.name = 'swing';
	}

	/** Six numbers of each follicle, displacement and velocity, at the beginning of the last sub-step. */
	get before(): Float32Array {
		return this.#before;
	}

	/** The same at its end. */
	get after(): Float32Array {
		return this.#after;
	}

	step(drive: Drive): void {
		const { after } = this;
		this.#after = this.#before;
		this.#before = after;
		this.#pull(drive);
		this.#exchange();
		this.#go(drive);
	}

	/** Finds where the forces lead: xₑ. */
	#pull({ sag, gale, blow, gusts, waves, fade }: Drive): void {
		const { follicles, comb } = this.#roots;
		const { count, position, normal, length } = follicles;
		const { offsets } = this.#strokes;
		const lead = this.#lead;
		const [sagX, sagY, sagZ] = [sag[0] as number, sag[1] as number, sag[2] as number];
		const [blowX, blowY, blowZ] = [blow[0] as number, blow[1] as number, blow[2] as number];
		for (let i = 0, at = 0; i < count; i++, at += 3) {
			const nx = normal[at] as number;
			const ny = normal[at + 1] as number;
			const nz = normal[at + 2] as number;
			let x = sagX;
			let y = sagY;
			let z = sagZ;
			if (gale > 0) {
				const facing = 0.5 + 0.5 * (nx * blowX + ny * blowY + nz * blowZ);
				let force = gale * (1 - LEE * facing * facing);
				if (gusts > 0) {
					const px = position[at] as number;
					const py = position[at + 1] as number;
					const pz = position[at + 2] as number;
					const gust =
						STRENGTHS[0] * wave(waves, 0, px, py, pz) +
						STRENGTHS[1] * wave(waves, 4, px, py, pz) +
						STRENGTHS[2] * wave(waves, 8, px, py, pz);
					const veer = VEER * gusts * force * wave(waves, 12, px, py, pz);
					force *= 1 + GUST * gusts * gust;
					x += veer * (ny * blowZ - nz * blowY);
					y += veer * (nz * blowX - nx * blowZ);
					z += veer * (nx * blowY - ny * blowX);
				}
				x += force * blowX;
				y += force * blowY;
				z += force * blowZ;
			}
			const long = length[i] as number;
			const out = x * nx + y * ny + z * nz;
			x = long * (x - out * nx) + fade * (offsets[4 * i] as number);
			y = long * (y - out * ny) + fade * (offsets[4 * i + 1] as number);
			z = long * (z - out * nz) + fade * (offsets[4 * i + 2] as number);
			const tipX = x + (comb[at] as number);
			const tipY = y + (comb[at + 1] as number);
			const tipZ = z + (comb[at + 2] as number);
			const far = tipX * tipX + tipY * tipY + tipZ * tipZ;
			const over = far > LIMIT * LIMIT ? 1 - LIMIT / Math.sqrt(far) : 0;
			lead[at] = x - over * tipX;
			lead[at + 1] = y - over * tipY;
			lead[at + 2] = z - over * tipZ;
		}
	}

	/** Neighbours give each other of what they have, from the last states to the new ones. */
	#exchange(): void {
		const { follicles, weights } = this.#roots;
		const { count, normal, first, links } = follicles;
		const old = this.#before;
		const states = this.#after;
		for (let i = 0; i < count; i++) {
			const at = STATE * i;
			const end = first[i + 1] as number;
			let own = 1;
			let x = 0;
			let y = 0;
			let z = 0;
			let vx = 0;
			let vy = 0;
			let vz = 0;
			for (let link = first[i] as number; link < end; link++) {
				const weight = weights[link] as number;
				const other = STATE * (links[link] as number);
				own -= weight;
				x += weight * (old[other] as number);
				y += weight * (old[other + 1] as number);
				z += weight * (old[other + 2] as number);
				vx += weight * (old[other + 3] as number);
				vy += weight * (old[other + 4] as number);
				vz += weight * (old[other + 5] as number);
			}
			x += own * (old[at] as number);
			y += own * (old[at + 1] as number);
			z += own * (old[at + 2] as number);
			vx += own * (old[at + 3] as number);
			vy += own * (old[at + 4] as number);
			vz += own * (old[at + 5] as number);
			const nx = normal[3 * i] as number;
			const ny = normal[3 * i + 1] as number;
			const nz = normal[3 * i + 2] as number;
			const out = x * nx + y * ny + z * nz;
			const away = vx * nx + vy * ny + vz * nz;
			states[at] = x - out * nx;
			states[at + 1] = y - out * ny;
			states[at + 2] = z - out * nz;
			states[at + 3] = vx - away * nx;
			states[at + 4] = vy - away * ny;
			states[at + 5] = vz - away * nz;
		}
	}

	/** Every spring makes its step, within the limit. */
	#go({ kick, kicks }: Drive): void {
		const { follicles, comb } = this.#roots;
		const { count, position, normal, length } = follicles;
		const { xx, xv, vx: vFromX, vv, fastest } = this.#spring;
		const lead = this.#lead;
		const states = this.#after;
		for (let i = 0, at = 0, s = 0; i < count; i++, at += 3, s += STATE) {
			let vx = states[s + 3] as number;
			let vy = states[s + 4] as number;
			let vz = states[s + 5] as number;
			let kickX = 0;
			let kickY = 0;
			let kickZ = 0;
			if (kicks) {
				// Half of it before the step and half of it after.
				const half = 0.5 * (length[i] as number);
				kickX = half * row(kick, 0, position, at);
				kickY = half * row(kick, 4, position, at);
				kickZ = half * row(kick, 8, position, at);
				const nx = normal[at] as number;
				const ny = normal[at + 1] as number;
				const nz = normal[at + 2] as number;
				const out = kickX * nx + kickY * ny + kickZ * nz;
				kickX -= out * nx;
				kickY -= out * ny;
				kickZ -= out * nz;
				vx += kickX;
				vy += kickY;
				vz += kickZ;
			}
			const leadX = lead[at] as number;
			const leadY = lead[at + 1] as number;
			const leadZ = lead[at + 2] as number;
			const fromX = (states[s] as number) - leadX;
			const fromY = (states[s + 1] as number) - leadY;
			const fromZ = (states[s + 2] as number) - leadZ;
			let tipX = leadX + xx * fromX + xv * vx + (comb[at] as number);
			let tipY = leadY + xx * fromY + xv * vy + (comb[at + 1] as number);
			let tipZ = leadZ + xx * fromZ + xv * vz + (comb[at + 2] as number);
			vx = vFromX * fromX + vv * vx + kickX;
			vy = vFromX * fromY + vv * vy + kickY;
			vz = vFromX * fromZ + vv * vz + kickZ;
			const far = tipX * tipX + tipY * tipY + tipZ * tipZ;
			if (far > LIMIT * LIMIT) {
				const share = LIMIT / Math.sqrt(far);
				tipX *= share;
				tipY *= share;
				tipZ *= share;
				// What would take it farther out.
				const out = Math.max((vx * tipX + vy * tipY + vz * tipZ) / (LIMIT * LIMIT), 0);
				vx -= out * tipX;
				vy -= out * tipY;
				vz -= out * tipZ;
			}
			const speed = vx * vx + vy * vy + vz * vz;
			const share = speed > fastest * fastest ? fastest / Math.sqrt(speed) : 1;
			states[s] = tipX - (comb[at] as number);
			states[s + 1] = tipY - (comb[at + 1] as number);
			states[s + 2] = tipZ - (comb[at + 2] as number);
			states[s + 3] = share * vx;
			states[s + 4] = share * vy;
			states[s + 5] = share * vz;
		}
	}

	show(share: number): void {
		const { count } = this.#roots.follicles;
		const texels = this.#texels;
		const before = this.#before;
		const after = this.#after;
		for (let i = 0, at = 0, texel = 0; i < count; i++, at += STATE, texel += 4) {
			for (let c = 0; c < 3; c++) {
				const from = before[at + c] as number;
				texels[texel + c] = from + share * ((after[at + c] as number) - from);
			}
		}
		this.swing.needsUpdate = true;
	}

	rest(): void {
		this.#before.fill(0);
		this.#after.fill(0);
	}

	dispose(): void {
		this.swing.dispose();
	}
}

/** A wave of parabolas, −1..1, that is as cheap as it looks; a sine would be told from it by nobody. */
function wave(waves: Float32Array, at: number, x: number, y: number, z: number): number {
	const turns =
		(waves[at] as number) * x +
		(waves[at + 1] as number) * y +
		(waves[at + 2] as number) * z +
		(waves[at + 3] as number);
	const phase = turns - Math.floor(turns + 0.5);
	return phase * (8 - 16 * Math.abs(phase));
}

/** A row of a matrix with four columns times (position, 1). */
function row(matrix: Float32Array, at: number, position: Float32Array, p: number): number {
	return (
		(matrix[at] as number) * (position[p] as number) +
		(matrix[at + 1] as number) * (position[p + 1] as number) +
		(matrix[at + 2] as number) * (position[p + 2] as number) +
		(matrix[at + 3] as number)
	);
}
