import { DataTexture, FloatType, RGBAFormat } from 'three';
import { FOLLICLES_PER_ROW } from '../body/FurFollicles.ts';
import { Blend } from './Blend.ts';
import { type Drive, GUST, LEE, STRENGTHS, VEER } from './drive.ts';
import type { Roots } from './roots.ts';
import type { Strokes } from './Strokes.ts';
import { type Solver, type SpringStates, STATE } from './solver.ts';
import { LIMIT, type Spring } from './spring.ts';

/**
 * A damped spring for every follicle, on the CPU.
 *
 * A sub-step is coupling, spring, limit. Coupling moves displacement and velocity towards the neighbours' by symmetric
 * weights and back into the tangent plane; its matrix P(1 − L)P, with P an orthogonal projection and 0 ≤ L < 1, lengthens
 * no vector, so it adds no energy. Neither does the damped spring, stepped exactly about the equilibrium of the forces, nor
 * the limit, the nearest point of a convex set around the rest. Acting alike on displacement and velocity, coupling
 * commutes with the equal springs.
 */
export class CpuSprings implements Solver, SpringStates {
	readonly swing: DataTexture;
	readonly #roots: Roots;
	readonly #spring: Spring;
	readonly #strokes: Strokes;
	readonly #blend: Blend;
	readonly #texels: Float32Array;
	/** SpringStates at the beginning and the end of the last sub-step. */
	#before: Float32Array;
	#after: Float32Array;

	constructor(roots: Roots, spring: Spring, strokes: Strokes) {
		const { count } = roots.follicles;
		const rows = Math.ceil(count / FOLLICLES_PER_ROW);
		this.#roots = roots;
		this.#spring = spring;
		this.#strokes = strokes;
		this.#blend = new Blend(roots.joints);
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

	/** Six numbers of each follicle at its end. */
	get after(): Float32Array {
		return this.#after;
	}

	// Long: one pass over the follicles reads each one's numbers once, which saves a quarter of the time.
	step(drive: Drive): void {
		const { gale, gusts, waves, kicks, ways, morphs, fade } = drive;
		const { sag, blow, kick, place } = this.#blend;
		const old = this.#after;
		const states = this.#before;
		this.#before = old;
		this.#after = states;
		const { follicles, joints, comb, weights } = this.#roots;
		const { count, position, normal, length, first, links } = follicles;
		const { offsets } = this.#strokes;
		const { xx, xv, vx: vFromX, vv, fastest } = this.#spring;
		const lanes = this.#strokes.widest > 0;
		// Fractions from the start: numbers that begin as integers become an object at each follicle.
		let sagX = sag[0] as number;
		let sagY = sag[1] as number;
		let sagZ = sag[2] as number;
		let blowX = blow[0] as number;
		let blowY = blow[1] as number;
		let blowZ = blow[2] as number;
		for (let i = 0, at = 0, s = 0, run = 0; i < count; i++, at += 3, s += STATE) {
			if (i === joints.first[run]) {
				this.#blend.set(drive, run++);
				sagX = sag[0] as number;
				sagY = sag[1] as number;
				sagZ = sag[2] as number;
				blowX = blow[0] as number;
				blowY = blow[1] as number;
				blowZ = blow[2] as number;
			}
			const nx = normal[at] as number;
			const ny = normal[at + 1] as number;
			const nz = normal[at + 2] as number;
			const combX = comb[at] as number;
			const combY = comb[at + 1] as number;
			const combZ = comb[at + 2] as number;
			const long = length[i] as number;
			const px = position[at] as number;
			const py = position[at + 1] as number;
			const pz = position[at + 2] as number;

			// Equilibrium of the forces: xₑ.
			let leadX = sagX;
			let leadY = sagY;
			let leadZ = sagZ;
			if (gale > 0) {
				const facing = 0.5 + 0.5 * (nx * blowX + ny * blowY + nz * blowZ);
				let force = gale * (1 - LEE * facing * facing);
				if (gusts > 0) {
					const x = row(place, 0, px, py, pz);
					const y = row(place, 4, px, py, pz);
					const z = row(place, 8, px, py, pz);
					const gust =
						STRENGTHS[0] * wave(waves, 0, x, y, z) +
						STRENGTHS[1] * wave(waves, 4, x, y, z) +
						STRENGTHS[2] * wave(waves, 8, x, y, z);
					const veer = VEER * gusts * force * wave(waves, 12, x, y, z);
					force *= 1 + GUST * gusts * gust;
					leadX += veer * (ny * blowZ - nz * blowY);
					leadY += veer * (nz * blowX - nx * blowZ);
					leadZ += veer * (nx * blowY - ny * blowX);
				}
				leadX += force * blowX;
				leadY += force * blowY;
				leadZ += force * blowZ;
			}
			const up = leadX * nx + leadY * ny + leadZ * nz;
			leadX = long * (leadX - up * nx);
			leadY = long * (leadY - up * ny);
			leadZ = long * (leadZ - up * nz);
			if (lanes) {
				leadX += fade * (offsets[4 * i] as number);
				leadY += fade * (offsets[4 * i + 1] as number);
				leadZ += fade * (offsets[4 * i + 2] as number);
			}
			let tipX = leadX + combX;
			let tipY = leadY + combY;
			let tipZ = leadZ + combZ;
			let far = tipX * tipX + tipY * tipY + tipZ * tipZ;
			if (far > LIMIT * LIMIT) {
				const over = 1 - LIMIT / Math.sqrt(far);
				leadX -= over * tipX;
				leadY -= over * tipY;
				leadZ -= over * tipZ;
			}

			// Coupling with the neighbours' last states, projected to the tangent plane.
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
			x += own * (old[s] as number);
			y += own * (old[s + 1] as number);
			z += own * (old[s + 2] as number);
			vx += own * (old[s + 3] as number);
			vy += own * (old[s + 4] as number);
			vz += own * (old[s + 5] as number);
			const out = x * nx + y * ny + z * nz;
			const away = vx * nx + vy * ny + vz * nz;
			x -= out * nx + leadX;
			y -= out * ny + leadY;
			z -= out * nz + leadZ;
			vx -= away * nx;
			vy -= away * ny;
			vz -= away * nz;

			// Step of the spring, with half of the kick before it and half after.
			let kickX = 0;
			let kickY = 0;
			let kickZ = 0;
			if (kicks) {
				const half = 0.5 * long;
				kickX = half * row(kick, 0, px, py, pz);
				kickY = half * row(kick, 4, px, py, pz);
				kickZ = half * row(kick, 8, px, py, pz);
				if (morphs) {
					kickX += half * (ways[4 * i] as number);
					kickY += half * (ways[4 * i + 1] as number);
					kickZ += half * (ways[4 * i + 2] as number);
				}
				const off = kickX * nx + kickY * ny + kickZ * nz;
				kickX -= off * nx;
				kickY -= off * ny;
				kickZ -= off * nz;
				vx += kickX;
				vy += kickY;
				vz += kickZ;
			}
			tipX = leadX + xx * x + xv * vx + combX;
			tipY = leadY + xx * y + xv * vy + combY;
			tipZ = leadZ + xx * z + xv * vz + combZ;
			vx = vFromX * x + vv * vx + kickX;
			vy = vFromX * y + vv * vy + kickY;
			vz = vFromX * z + vv * vz + kickZ;
			far = tipX * tipX + tipY * tipY + tipZ * tipZ;
			if (far > LIMIT * LIMIT) {
				const share = LIMIT / Math.sqrt(far);
				tipX *= share;
				tipY *= share;
				tipZ *= share;
				// Outward part of the velocity.
				const outward = Math.max((vx * tipX + vy * tipY + vz * tipZ) / (LIMIT * LIMIT), 0);
				vx -= outward * tipX;
				vy -= outward * tipY;
				vz -= outward * tipZ;
			}
			const speed = vx * vx + vy * vy + vz * vz;
			const share = speed > fastest * fastest ? fastest / Math.sqrt(speed) : 1;
			states[s] = tipX - combX;
			states[s + 1] = tipY - combY;
			states[s + 2] = tipZ - combZ;
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

/** Wave of parabolas, −1..1: a cheap sine. */
function wave(waves: Float32Array, at: number, x: number, y: number, z: number): number {
	const turns =
		(waves[at] as number) * x +
		(waves[at + 1] as number) * y +
		(waves[at + 2] as number) * z +
		(waves[at + 3] as number);
	const phase = turns - Math.floor(turns + 0.5);
	return phase * (8 - 16 * Math.abs(phase));
}

/** Row of a matrix with four columns times (position, 1). */
function row(matrix: Float64Array, at: number, x: number, y: number, z: number): number {
	return (
		(matrix[at] as number) * x +
		(matrix[at + 1] as number) * y +
		(matrix[at + 2] as number) * z +
		(matrix[at + 3] as number)
	);
}
