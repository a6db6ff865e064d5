import { Vector3 } from 'three';
import { type Drive, WAVES } from './drive.ts';

/** Displacement of the longest tips by a storm from ahead, share of the length. */
const LAY = 0.7;

/** Turns of each wave per radius of the body; the last one turns the wind, the others strengthen it. */
const TURNS = [0.9, 1.4, 2.6, 0.6] as const;
/** Largest angle of each wave to the wind, radians. */
const STRAY = [0.25, 0.7, 0.5, 0.6] as const;
/** Speed of each wave, shares of the gusts' speed. */
const SPEED = [1, 0.85, 1.2, 0.9] as const;
/** Speed of gusts in the faintest wind, and its increase up to a storm, radii of the body per second. */
const BREATH = 0.5;
const STORM = 1.4;

/** Settings of the wind. It is uniform but for its gusts, which run over the fur. */
export interface FurWind {
	/** Direction in which it blows, world axes; any length, 0 is no wind. */
	readonly direction: Vector3;
	/** Strength: 0 is none, 1 a storm that lays the fur. */
	strength: number;
	/** Strength of gusts: 0 is steady; 1 swells and slackens by two thirds, and turns a little. */
	gusts: number;
}

/** Wind with seeded waves that travel along it. For their effect on a follicle see `CpuSprings` and springs.frag.glsl. */
export class Wind implements FurWind {
	readonly direction = new Vector3(1, 0, 0);
	strength = 0;
	gusts = 0.6;
	/** Components of each wave along the wind and along the two axes across, and its initial phase, turns. */
	readonly #waves = new Float64Array(4 * WAVES);
	/** Distance that gusts have travelled, radii of the body. */
	#travel = 0;
	/** Settings at the last call of `stirs`. */
	readonly #known = { direction: new Vector3(), force: 0, gusts: 0 };
	readonly #along = new Vector3();
	readonly #right = new Vector3();
	readonly #up = new Vector3();
	readonly #wave = new Vector3();

	constructor(seed: number) {
		const next = random(seed);
		for (const [w, most] of STRAY.entries()) {
			const [stray, roll] = [most * (2 * next() - 1), 2 * Math.PI * next()];
			const across = Math.sin(stray);
			this.#waves.set([Math.cos(stray), across * Math.cos(roll), across * Math.sin(roll), next()], 4 * w);
		}
	}

	/** Bounded strength. */
	get #force(): number {
		return this.direction.lengthSq() > 0 ? share(this.strength) : 0;
	}

	/** Whether the wind varies by itself, or its settings have changed since the last call. */
	stirs(): boolean {
		const known = this.#known;
		const force = this.#force;
		const gusts = share(this.gusts);
		const other = known.gusts !== gusts || !known.direction.equals(this.direction);
		const stirs = known.force !== force || (force > 0 && (gusts > 0 || other));
		known.force = force;
		known.gusts = gusts;
		known.direction.copy(this.direction);
		return stirs;
	}

	/** Restarts the waves. */
	reset(): void {
		this.#known.force = 0;
		this.#travel = 0;
	}

	/** Advances the gusts. */
	advance(seconds: number): void {
		this.#travel += seconds * (BREATH + STORM * this.#force);
	}

	/** Writes the wind's part of the drive. @param steady whether to leave out gusts */
	write(drive: Drive, steady: boolean): void {
		const along = this.#along.copy(this.direction).normalize();
		const right = this.#right.set(along.z, 0, -along.x);
		if (right.lengthSq() < 1e-6) right.set(1, 0, 0);
		right.normalize();
		const up = this.#up.crossVectors(along, right);
		const wave = this.#wave;
		for (let w = 0; w < WAVES; w++) {
			const turns = TURNS[w] as number;
			wave.copy(along).multiplyScalar(this.#waves[4 * w] as number);
			wave.addScaledVector(right, this.#waves[4 * w + 1] as number);
			wave.addScaledVector(up, this.#waves[4 * w + 2] as number);
			const phase = (this.#waves[4 * w + 3] as number) - turns * (SPEED[w] as number) * this.#travel;
			wave.multiplyScalar(turns).toArray(drive.waves, 4 * w);
			drive.waves[4 * w + 3] = phase - Math.floor(phase);
		}
		along.toArray(drive.blow);
		drive.gale = LAY * this.#force;
		drive.gusts = steady ? 0 : share(this.gusts);
	}
}

/** Numbers in 0..1, the same for the same seed (Park and Miller 1988). */
function random(seed: number): () => number {
	let state = (Math.abs(Math.trunc(seed)) % 2147483646) + 1;
	const next = () => {
		state = (state * 48271) % 2147483647;
		return state / 2147483647;
	};
	// Skip the small numbers that small seeds begin with.
	for (let i = 0; i < 4; i++) next();
	return next;
}

const share = (value: number) => Math.min(Math.max(value, 0), 1) || 0;
