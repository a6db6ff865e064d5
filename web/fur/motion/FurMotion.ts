import { Matrix4, type Mesh, type Object3D, type Texture, type Vector3, type WebGLRenderer } from 'three';
import { FurAttachment } from '../body/FurAttachment.ts';
import type { FurFollicles } from '../body/FurFollicles.ts';
import { Morphs } from '../body/Morphs.ts';
import type { FurAsset } from '../format.ts';
import { needFur } from '../needFur.ts';
import { BodyMotion } from './BodyMotion.ts';
import { CpuSprings } from './CpuSprings.ts';
import { calm, type Drive } from './drive.ts';
import { GpuSprings } from './GpuSprings.ts';
import { completed, type FurMotionOptions } from './options.ts';
import { type Roots, rootsOf } from './roots.ts';
import { Stopwatch } from './Stopwatch.ts';
import { Strokes } from './Strokes.ts';
import type { Solver } from './solver.ts';
import { type Spring, STEP, springOf } from './spring.ts';
import { type FurWind, Wind } from './Wind.ts';

/** Longest frame, seconds; the rest (of a hidden tab, say) is dropped. */
const MAX_FRAME = 0.5;
/** Budget of the springs on the CPU, milliseconds a frame. */
const BUDGET = 2;
/** Swing that counts as none, shares of the length. */
const MIN_SWING = 1e-3;

/** Largest gravity, in baked ones. */
const MAX_GRAVITY = 100;

/** Body in motion: a `Fur`. */
export interface FurMotionBody {
	/** Points of the skin, in the axes of the shells. */
	readonly follicles: FurFollicles;
	/** Shells, whose placement is the body's. */
	readonly shells: Mesh;
	/** Longest fur as baked, model units. */
	readonly asset: Pick<FurAsset, 'length'>;
	/** The skin, whose morph targets move the body. */
	readonly ground?: { readonly skin: { readonly pose: { readonly influences: readonly number[] } | undefined } };
	/** Attached motion, if any. */
	motion: FurMotion | undefined;
}

/**
 * Motion of fur: hairs are damped springs under gravity, wind, their body's motion and fingers.
 *
 *     const motion = new FurMotion(fur, { renderer }); // is fur.motion
 *     motion.wind.strength = 0.4;
 *     // each frame, before it is drawn
 *     fur.update(seconds);
 *
 * The body's node and bones may be moved freely, by clips too: `Fur.update` reads their placements. Other furs of the same body share it by
 * `dressed.motion = motion`. Time advances in sub-steps of a thirtieth of a second at
 * any frame rate, shown one sub-step late. Without forces the fur falls asleep as it was baked, and costs nothing.
 */
export class FurMotion extends FurAttachment {
	/** Wind; set its properties. */
	readonly wind: FurWind;
	/** Gravity over the baked one: 0 is weightless. */
	gravity: number;
	readonly #renderer: WebGLRenderer | undefined;
	readonly #roots: Roots;
	readonly #spring: Spring;
	readonly #wind: Wind;
	readonly #bodyMotion: BodyMotion;
	readonly #strokes: Strokes;
	readonly #stopwatch: Stopwatch;
	readonly #drive: Drive;
	readonly #shells: Object3D;
	readonly #meshFromWorld = new Matrix4();
	#solver: Solver;
	/** Seconds since the end of the last sub-step. */
	#behind = 0;
	/** Upper bound of all swings about the equilibrium, in the norm of `Spring.decay`. */
	#unrest = 0;
	/** Last gravity; NaN before the first frame. */
	#weight = Number.NaN;
	/** Whether hairs at rest are bent. */
	#bent = false;
	#asleep = true;
	/** Whether CPU and GPU have been compared; a software renderer's GPU is slower. */
	#compared = false;

	/** @param body fur to attach to, in place of its motion before; not one made by `dressFur` */
	constructor(body: FurMotionBody, options: FurMotionOptions = {}) {
		super();
		needFur('FurMotion', body);
		const { frequency, damping, coupling, relaxation, gravity, seed, clock } = completed(options);
		const { shells, asset, follicles } = body;
		this.#renderer = options.renderer;
		this.gravity = gravity;
		this.#roots = rootsOf(follicles, coupling);
		this.#spring = springOf(frequency, damping);
		this.wind = this.#wind = new Wind(seed);
		this.#strokes = new Strokes(follicles, relaxation);
		const furLength = asset.length / shells.scale.x;
		const { joints } = this.#roots;
		const influences = () => body.ground?.skin.pose?.influences ?? [];
		this.#bodyMotion = new BodyMotion(shells, follicles, joints, furLength, this.#spring.pace, influences);
		this.#shells = shells;
		this.#drive = calm(joints.bones.length, Morphs.of(shells.geometry) ? follicles.count : 0);
		this.#stopwatch = new Stopwatch(BUDGET, clock);
		this.#solver = new CpuSprings(this.#roots, this.#spring, this.#strokes);
		body.motion = this;
	}

	/** Present displacements, as in `Fur.swing`. Undefined means as baked. */
	get swing(): Texture | undefined {
		return this.#asleep && !this.#bent ? undefined : this.#solver.swing;
	}

	/** Whether nothing moves until a force changes. */
	get asleep(): boolean {
		return this.#asleep;
	}

	/**
	 * Processor that moves the hairs: first the CPU; when that takes more than 2 ms a frame, the GPU is tried once and kept if
	 * faster.
	 */
	get processor(): 'cpu' | 'gpu' {
		return this.#solver instanceof GpuSprings ? 'gpu' : 'cpu';
	}

	/**
	 * Advances by a frame.
	 *
	 * @param seconds since the last frame; more than half a second counts as half a second
	 * @returns whether the picture changes
	 * @internal
	 */
	override update(seconds: number): boolean {
		if (!(seconds > 0)) return !this.#asleep;
		const moved = this.#bodyMotion.look(seconds);
		if (this.#driven(moved)) this.#wake();
		if (this.#asleep) return false;
		this.#stopwatch.start();
		const steps = this.#advance(Math.min(seconds, MAX_FRAME));
		this.#solver.show(this.#behind / STEP);
		if (steps > 0 && this.#renderer) this.#compare(this.#renderer, steps);
		if (this.#unrest < MIN_SWING && this.#strokes.widest === 0) this.#sleep();
		this.show();
		return true;
	}

	/**
	 * Strokes the fur along a finger's path since the last frame; the lane fades over seconds. Points are on the skin, world
	 * axes; on a body in a pose they are those of the body at rest where its node stands.
	 *
	 * @param from start
	 * @param to end
	 * @param radius of the lane, world units
	 */
	stroke(from: Vector3, to: Vector3, radius: number): void {
		const shells = this.#shells;
		shells.updateWorldMatrix(true, false);
		const own = radius / shells.matrixWorld.getMaxScaleOnAxis();
		if (!(own > 0)) return;
		this.#meshFromWorld.copy(shells.matrixWorld).invert();
		this.#strokes.add(from, to, this.#meshFromWorld, own);
	}

	/** Jumps to the equilibrium of gravity, lanes and a wind without gusts: for still pictures. */
	settle(): void {
		this.#bodyMotion.place();
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
		this.show();
	}

	/** Resets to the baked pose without lanes; wind and gravity act from there. */
	reset(): void {
		this.#bodyMotion.place();
		this.#strokes.reset();
		this.#wind.reset();
		this.#weight = Number.NaN;
		this.#bent = false;
		this.#unrest = 0;
		this.#sleep();
		this.show();
	}

	/** Frees its resources and leaves all furs that it moved as baked. */
	override dispose(): void {
		super.dispose();
		this.#solver.dispose();
	}

	/** Whether any force has changed since the last frame. */
	#driven(moved: boolean): boolean {
		const weight = this.#gravity;
		const first = Number.isNaN(this.#weight);
		const heavier = first ? this.#bodyMotion.sags(weight) : weight !== this.#weight;
		this.#weight = weight;
		const stirs = this.#wind.stirs();
		return moved || heavier || stirs || this.#strokes.pending || !this.#bodyMotion.caughtUp() || this.#lost;
	}

	/** Bounded gravity. */
	get #gravity(): number {
		return Math.min(Math.max(this.gravity, -MAX_GRAVITY), MAX_GRAVITY) || 0;
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

	/** @returns number of sub-steps */
	#advance(frame: number): number {
		let steps = 0;
		let left = frame;
		let before = 0;
		while (this.#behind + left >= STEP) {
			left -= STEP - this.#behind;
			const now = 1 - left / frame;
			this.#bodyMotion.advance(STEP - this.#behind);
			this.#behind = 0;
			const { widest } = this.#strokes;
			this.#strokes.advance(before, now);
			// Rests of lanes that have just ended swing out.
			if (this.#strokes.widest === 0) this.#unrest += this.#spring.widest * widest;
			this.#wind.advance(STEP / 2);
			this.#pull(now, false);
			this.#wind.advance(STEP / 2);
			this.#solver.step(this.#drive);
			this.#unrest *= this.#spring.decay;
			before = now;
			steps++;
		}
		this.#bodyMotion.advance(left);
		this.#behind += left;
		this.#strokes.endFrame();
		return steps;
	}

	/** Writes the forces of a sub-step. @param share of the frame at its end */
	#pull(share: number, steady: boolean): void {
		const drive = this.#drive;
		this.#bodyMotion.write(drive, share, this.#gravity);
		this.#wind.write(drive, steady);
		drive.fade = this.#strokes.fade;
		this.#bent = drive.gale > 0 || drive.sags;
	}

	#stepsToRest(): number {
		return Math.ceil(Math.log(MIN_SWING / this.#spring.widest) / Math.log(this.#spring.decay));
	}

	/** Moves to the GPU if the CPU is too slow and the GPU faster. @param steps sub-steps of this frame */
	#compare(renderer: WebGLRenderer, steps: number): void {
		const solver = this.#solver;
		if (this.#compared || !(solver instanceof CpuSprings)) return;
		const time = this.#stopwatch.stop();
		if (time === 0) return;
		this.#compared = true;
		if (!GpuSprings.suits(renderer, this.#roots)) return;
		const other = new GpuSprings(renderer, this.#roots, this.#spring, this.#strokes, solver, this.#drive.ways);
		// Compile first, untimed.
		other.rehearse(this.#drive, 1);
		this.#stopwatch.start();
		other.rehearse(this.#drive, steps);
		const faster = this.#stopwatch.lap() < time;
		other.show(this.#behind / STEP);
		this.#solver = faster ? other : solver;
		(faster ? solver : other).dispose();
	}
}
