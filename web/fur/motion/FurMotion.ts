import { Matrix4, type Texture, type Vector3, type WebGLRenderer } from 'three';
import type { Fur } from '../Fur.ts';
import { Carriage } from './Carriage.ts';
import { CpuSprings } from './CpuSprings.ts';
import { calm } from './drive.ts';
import { GpuSprings } from './GpuSprings.ts';
import { completed, type MotionOptions } from './options.ts';
import { type Roots, rootsOf } from './roots.ts';
import { Stopwatch } from './Stopwatch.ts';
import { Strokes } from './Strokes.ts';
import type { Solver } from './solver.ts';
import { type Spring, STEP, springOf } from './spring.ts';
import { Wind, type WindSettings } from './Wind.ts';

/** Seconds of a frame that count: of more, a hidden tab's say, the rest is dropped. */
const LONGEST = 0.5;
/** Milliseconds a frame that springs may take on the CPU. */
const BUDGET = 2;
/** What is left of a swing when it counts as none, shares of the length. */
const NOTHING = 1e-3;

/** Gravities that count. */
const MOST_GRAVITY = 100;

/**
 * Fur that moves: hairs are damped springs which gravity, wind, their body's motion and fingers pull at.
 *
 *     const motion = new FurMotion(fur, { renderer });
 *     motion.wind.strength = 0.4;
 *     // each frame, before it is drawn
 *     if (motion.update(seconds)) for (const other of dressed) other.swing = motion.swing;
 *     renderer.render(scene, camera);
 *
 * The body's node may be moved by whatever moves it: `update` looks where it is. Time goes in sub-steps of a thirtieth of a
 * second, whatever the frame rate is, and what is seen is one of them behind. Without anything that pulls at it the fur falls
 * asleep, as it was baked, and costs nothing.
 */
export class FurMotion {
	/** What blows at it, to be set. */
	readonly wind: WindSettings;
	/** Gravities: 1 is what it was baked under, 0 weightless. */
	gravity: number;
	readonly #body: Fur;
	readonly #renderer: WebGLRenderer | undefined;
	readonly #roots: Roots;
	readonly #spring: Spring;
	readonly #wind: Wind;
	readonly #carriage: Carriage;
	readonly #strokes: Strokes;
	readonly #stopwatch: Stopwatch;
	readonly #drive = calm();
	readonly #meshFromWorld = new Matrix4();
	#solver: Solver;
	/** Seconds since the end of the last sub-step. */
	#behind = 0;
	/** An upper bound of how far hairs swing about where they are pulled to, in the norm of `Spring.decay`. */
	#unrest = 0;
	/** Gravity as it was; NaN before anything was. */
	#weight = Number.NaN;
	/** Whether hairs are bent although they are still. */
	#bent = false;
	#asleep = true;
	/** Whether CPU and GPU have been compared: a software renderer's GPU is the CPU, and slower. */
	#compared = false;

	/** @param body whose shells move, and whose axes its hairs move in; not one that `dress` made */
	constructor(body: Fur, options: MotionOptions = {}) {
		const { frequency, damping, coupling, relaxation, gravity, seed, clock } = completed(options);
		const { shells, asset, follicles } = body;
		this.#body = body;
		this.#renderer = options.renderer;
		this.gravity = gravity;
		this.#roots = rootsOf(follicles, coupling);
		this.#spring = springOf(frequency, damping);
		this.wind = this.#wind = new Wind(seed);
		this.#strokes = new Strokes(follicles, relaxation);
		const furLength = asset.length / shells.scale.x;
		this.#carriage = new Carriage(shells, follicles.position, furLength, this.#spring.pace);
		this.#stopwatch = new Stopwatch(BUDGET, clock);
		this.#solver = new CpuSprings(this.#roots, this.#spring, this.#strokes);
	}

	/** Where the hairs are, as `Fur.swing` takes it: of the body and of all that is dressed on it. Undefined as it was baked. */
	get swing(): Texture | undefined {
		return this.#asleep && !this.#bent ? undefined : this.#solver.swing;
	}

	/** Whether nothing moves, nor will before something pulls at it. */
	get asleep(): boolean {
		return this.#asleep;
	}

	/**
	 * Which of them moves the hairs. It begins on the CPU; when that takes more than 2 ms a frame, the GPU is tried once, and
	 * goes on if it takes less.
	 */
	get processor(): 'cpu' | 'gpu' {
		return this.#solver instanceof GpuSprings ? 'gpu' : 'cpu';
	}

	/**
	 * Goes on by a frame; once before it is drawn.
	 *
	 * @param seconds since the last frame; of more than half a second the rest is dropped
	 * @returns whether the picture changes
	 */
	update(seconds: number): boolean {
		if (!(seconds > 0)) return !this.#asleep;
		const moved = this.#carriage.look(seconds);
		if (this.#driven(moved)) this.#wake();
		if (this.#asleep) return false;
		this.#stopwatch.start();
		const steps = this.#advance(Math.min(seconds, LONGEST));
		this.#solver.show(this.#behind / STEP);
		if (steps > 0 && this.#renderer) this.#compare(this.#renderer, steps);
		if (this.#unrest < NOTHING && this.#strokes.widest === 0) this.#sleep();
		this.#body.swing = this.swing;
		return true;
	}

	/**
	 * A finger has gone over the fur since the last frame, and leaves a lane that fades over seconds.
	 *
	 * @param from where it was on the skin, in the world
	 * @param to where it is now
	 * @param radius of the lane, world units
	 */
	stroke(from: Vector3, to: Vector3, radius: number): void {
		const { shells } = this.#body;
		shells.updateWorldMatrix(true, false);
		const own = radius / shells.matrixWorld.getMaxScaleOnAxis();
		if (!(own > 0)) return;
		this.#meshFromWorld.copy(shells.matrixWorld).invert();
		this.#strokes.add(from, to, this.#meshFromWorld, own);
	}

	/** Goes at once where gravity, lanes and a wind without gusts lead: for pictures in which nothing moves. */
	settle(): void {
		this.#carriage.place();
		this.#strokes.finish();
		this.#wind.stirs();
		this.#weight = this.#gravity;
		this.#pull(1, true);
		this.#solver.rest();
		const steps = this.#bent || this.#strokes.widest > 0 ? this.#stepsToRest() : 0;
		for (let i = 0; i < steps; i++) this.#solver.step(this.#drive);
		this.#behind = 0;
		this.#unrest = 0;
		this.#asleep = this.#strokes.widest === 0;
		if (steps > 0) this.#solver.show(1);
		this.#body.swing = this.swing;
	}

	/** As it was baked, without lanes; wind and gravity pull on from there. */
	reset(): void {
		this.#carriage.place();
		this.#strokes.reset();
		this.#wind.reset();
		this.#weight = Number.NaN;
		this.#bent = false;
		this.#unrest = 0;
		this.#sleep();
		this.#body.swing = undefined;
	}

	/** Frees what it has, and leaves all fur that it moved as it was baked, the body's and what is dressed on it. */
	dispose(): void {
		this.#body.swing = undefined;
		this.#solver.dispose();
	}

	/** Whether anything pulls otherwise than it did in the last frame. */
	#driven(moved: boolean): boolean {
		const weight = this.#gravity;
		const first = Number.isNaN(this.#weight);
		const heavier = first ? this.#carriage.sag(weight).lengthSq() > 0 : weight !== this.#weight;
		this.#weight = weight;
		const stirs = this.#wind.stirs();
		return moved || heavier || stirs || this.#strokes.pending || !this.#carriage.settles() || this.#lost;
	}

	/** As it is used. */
	get #gravity(): number {
		return Math.min(Math.max(this.gravity, -MOST_GRAVITY), MOST_GRAVITY) || 0;
	}

	get #lost(): boolean {
		return this.#solver instanceof GpuSprings && this.#solver.lost;
	}

	#wake(): void {
		if (this.#lost) this.#solver.rest();
		this.#asleep = false;
		this.#unrest = this.#spring.widest;
	}

	#sleep(): void {
		this.#asleep = true;
		this.#behind = 0;
		if (!this.#bent) this.#solver.rest();
	}

	/** @returns how many sub-steps there were */
	#advance(frame: number): number {
		let steps = 0;
		let left = frame;
		let before = 0;
		while (this.#behind + left >= STEP) {
			left -= STEP - this.#behind;
			const now = 1 - left / frame;
			this.#carriage.advance(STEP - this.#behind);
			this.#behind = 0;
			const { widest } = this.#strokes;
			this.#strokes.advance(before, now);
			// What is left of lanes that have just come to their end swings out.
			if (this.#strokes.widest === 0) this.#unrest += this.#spring.widest * widest;
			this.#wind.advance(STEP / 2);
			this.#pull(now, false);
			this.#wind.advance(STEP / 2);
			this.#solver.step(this.#drive);
			this.#unrest *= this.#spring.decay;
			before = now;
			steps++;
		}
		this.#carriage.advance(left);
		this.#behind += left;
		this.#strokes.endFrame();
		return steps;
	}

	/** Writes what pulls in a sub-step. @param share of the frame at its end */
	#pull(share: number, steady: boolean): void {
		const drive = this.#drive;
		const { center, radius } = this.#carriage.sphere;
		this.#carriage.write(drive, share, this.#gravity);
		this.#wind.write(drive, this.#carriage.turn, center, radius, steady);
		drive.fade = this.#strokes.fade;
		this.#bent = drive.gale > 0 || drive.sag[0] !== 0 || drive.sag[1] !== 0 || drive.sag[2] !== 0;
	}

	#stepsToRest(): number {
		return Math.ceil(Math.log(NOTHING / this.#spring.widest) / Math.log(this.#spring.decay));
	}

	/** Where the CPU takes too long, and the GPU less, the GPU goes on. @param steps of this frame */
	#compare(renderer: WebGLRenderer, steps: number): void {
		const solver = this.#solver;
		if (this.#compared || !(solver instanceof CpuSprings)) return;
		const time = this.#stopwatch.stop();
		if (time === 0) return;
		this.#compared = true;
		if (!GpuSprings.suits(renderer, this.#roots)) return;
		const other = new GpuSprings(renderer, this.#roots, this.#spring, this.#strokes, solver);
		// What is compiled for it does not count.
		other.rehearse(this.#drive, 1);
		this.#stopwatch.start();
		other.rehearse(this.#drive, steps);
		const faster = this.#stopwatch.lap() < time;
		other.show(this.#behind / STEP);
		this.#solver = faster ? other : solver;
		(faster ? solver : other).dispose();
	}
}
