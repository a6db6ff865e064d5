/** Dynamics of the body on show: its clips, motion of its hairs, water and dirt on them, and its own sway. */

import { DataTexture, FloatType, MathUtils, RGBAFormat, type Vector3 } from 'three';
import type { FurMotion, FurWeather } from '../../fur/index.ts';
import { notice, withdraw } from '../say/notice.ts';
import type { Stage } from '../stage/stage.ts';
import type { View } from '../state/view.ts';
import { words } from '../words/index.ts';
import type { Looks } from './looks.ts';
import { Sway } from './sway.ts';

/** Variation of the wind, share of its strength. */
const GUSTS = 0.7;
/** Seconds until soaked fur is dry; milliseconds between frames while it dries and nothing moves. */
const DRYING_TIME = 90;
const DRYING_INTERVAL = 100;

export class Dynamics {
	/** Motion of the body as a whole. */
	readonly sway = new Sway();
	readonly #looks: Looks;
	readonly #stage: Stage;
	readonly #calm: boolean;
	#motion: FurMotion | undefined;
	#Motion: typeof FurMotion | undefined;
	/** First request of what moves hairs, by a frame; none repeats it. */
	#asked: Promise<void> | undefined;
	#weather: FurWeather | undefined;
	#Weather: typeof FurWeather | undefined;
	/** Swing of hairs at rest, which compiles their shaders: for the next frame, and of the last one. */
	#warmUpSwing: DataTexture | undefined;
	#lastWarmUpSwing: DataTexture | undefined;

	/** @param calm nothing moves by itself: wind bends the hairs and stays, and the turntable rests */
	constructor(looks: Looks, stage: Stage, calm: boolean) {
		this.#looks = looks;
		this.#stage = stage;
		this.#calm = calm;
	}

	/** True while heads follow the lamp. */
	#looksAtLamp = false;
	/** Called with the seconds into the clip when that has another pose. */
	posed: (time: number) => void = () => {};
	/** True while a brush that wets or soils is chosen. */
	brushStains = false;
	/** True once something was painted, which no link has. */
	get hasPaint(): boolean {
		return this.#weather?.painted ?? false;
	}

	/** True for a view that needs a part of the library that `loadMotion` loads. */
	lacksMotion({ wind: [strength] = [0, 0] }: View): boolean {
		return strength > 0 && !this.#Motion;
	}

	/** Loads what moves hairs; where that fails, they stay as they are until it is asked for again. */
	async loadMotion(): Promise<void> {
		try {
			this.#Motion = (await import('./later.ts')).FurMotion;
		} catch {
			this.#Motion = undefined;
		}
	}

	/** True for fur that is wet or dirty, or about to be. */
	needsStates({ wet = 0, dirt = 0 }: View): boolean {
		return wet > 0 || dirt > 0 || this.hasPaint || this.brushStains;
	}

	/**
	 * Fetches the wet and dirty states of the fur on show; where that fails, says why.
	 *
	 * @returns true if they are there
	 */
	async load(): Promise<boolean> {
		try {
			[{ FurWeather: this.#Weather }] = await Promise.all([import('./later.ts'), this.#looks.loadStates()]);
			withdraw('states');
			return true;
		} catch (error) {
			notice(words.statesNotShown((error as Error).message), 'error', 'states');
			return false;
		}
	}

	/** Styles clip, wind, wetness, dirt and turntable by the view; motion and weather are made on first use. */
	style(view: View): void {
		const { wind: [strength, direction] = [0, 0], wet = 0, dirt = 0, turn, crowd = 1 } = view;
		this.pose(view);
		const alone = crowd <= 1;
		if (!alone) this.#resetBody();
		this.sway.turning = Boolean(turn) && alone && !this.#calm;
		if (strength > 0 || this.#motion) this.#styleWind(strength, MathUtils.degToRad(direction));
		if (wet > 0 || dirt > 0 || this.#weather) this.#styleWeather(wet, dirt);
	}

	/** Plays the view's clip, or holds it. */
	pose({ clip, time, speed = 1, look = true }: View): void {
		const clips = this.#stage.model?.clips;
		this.#looksAtLamp = look && !this.#calm;
		if (!clips) return;
		clips.speed = speed;
		clips.choose(clip ?? (clips.names[0] as string));
		if (time === undefined) clips.play();
		else clips.hold(time);
	}

	/** Brings the body to its clip's pose. @returns true for a new pose */
	#stepClip(seconds: number): boolean {
		const clips = this.#stage.model?.clips;
		clips?.gaze?.aim(this.#looksAtLamp ? this.#stage.toLamp : undefined);
		if (!clips?.step(seconds)) return false;
		this.#stage.followPose();
		this.posed(clips.time);
		// Hairs lag behind a body that moves.
		if (this.#calm) this.#motion?.settle();
		else if (clips.moves) this.#needMotion();
		return true;
	}

	#styleWind(strength: number, direction: number): void {
		const motion = this.#needMotion();
		if (!motion) return;
		const { wind } = motion;
		const [x, z] = [Math.sin(direction), Math.cos(direction)];
		if (strength === wind.strength && x === wind.direction.x && z === wind.direction.z) return;
		wind.strength = strength;
		wind.direction.set(x, 0, z);
		wind.gusts = this.#calm ? 0 : GUSTS;
		if (this.#calm) motion.settle();
	}

	#styleWeather(wet: number, dirt: number): void {
		const weather = this.#needWeather();
		if (!weather) return;
		weather.wetness = wet;
		weather.dirt = dirt;
	}

	#needMotion(): FurMotion | undefined {
		const { body } = this.#looks;
		if (!this.#Motion) this.#asked ??= this.loadMotion();
		else if (body) this.#motion ??= new this.#Motion(body, { renderer: this.#stage.renderer });
		return this.#motion;
	}

	#needWeather(): FurWeather | undefined {
		const { body, states } = this.#looks;
		const { wet, dirt } = states;
		if (this.#Weather && body && (wet || dirt)) this.#weather ??= new this.#Weather(body, { drying: DRYING_TIME });
		return this.#weather;
	}

	/** Makes the hairs swing from the first frame on where the clip moves the body. */
	async prepare(): Promise<void> {
		if (this.#calm || !this.#stage.model?.clips?.moves) return;
		await this.loadMotion();
		this.#needMotion();
	}

	/** Draws the next frame with a swing of zero: shaders of moving hairs are compiled before the first stroke. */
	warmUp(): void {
		const { body } = this.#looks;
		if (!this.#Motion) this.#asked ??= this.loadMotion();
		if (!body || this.#motion) return;
		const { columns, rows } = body.follicles;
		this.#warmUpSwing = new DataTexture(new Float32Array(4 * columns * rows), columns, rows, RGBAFormat, FloatType);
		this.#warmUpSwing.needsUpdate = true;
	}

	/** Strokes the fur. Points on the skin and radius in world units. */
	stroke(from: Vector3, to: Vector3, radius: number): void {
		this.#needMotion()?.stroke(from, to, radius);
	}

	/** @param amount 0..1: wet through */
	rain(point: Vector3, radius: number, amount: number): void {
		this.#needWeather()?.rain(point, radius, amount);
	}

	/** @param amount 0..1: all muddy */
	mud(point: Vector3, radius: number, amount: number): void {
		this.#needWeather()?.mud(point, radius, amount);
	}

	/** Dries and cleans the fur at once. */
	clean(): void {
		this.#weather?.clean();
	}

	/** Resets fur and body to dry, clean and at rest. */
	reset(): void {
		this.clean();
		this.#resetBody();
		this.#motion?.reset();
	}

	/** Puts the body in its place at once. */
	#resetBody(): void {
		this.sway.reset();
		this.#stage.moveBody(this.sway.offset, this.sway.yaw);
	}

	/**
	 * Moves on by some seconds.
	 *
	 * @returns milliseconds until another frame is wanted: 0 at once, Infinity none
	 */
	step(seconds: number): number {
		const { sway } = this;
		const playing = this.#stepClip(seconds) && this.#stage.model?.clips?.moves;
		const swung = sway.step(seconds);
		if (swung) {
			this.#stage.moveBody(sway.offset, sway.yaw);
			this.#needMotion();
		}
		this.#lastWarmUpSwing?.dispose();
		this.#lastWarmUpSwing = this.#warmUpSwing;
		this.#warmUpSwing = undefined;
		this.#looks.update(seconds, this.#motion, this.#weather, this.#lastWarmUpSwing);
		if (playing || swung || this.#motion?.asleep === false || this.#lastWarmUpSwing) return 0;
		return this.#weather?.drying ? DRYING_INTERVAL : Number.POSITIVE_INFINITY;
	}

	/** Call while the context is lost: motion begins anew. */
	loseContext(): void {
		this.#motion?.dispose();
		this.#lastWarmUpSwing?.dispose();
		this.#motion = this.#warmUpSwing = this.#lastWarmUpSwing = undefined;
	}

	/** Call before the body is disposed of. */
	clear(): void {
		this.loseContext();
		this.#weather?.dispose();
		this.#weather = undefined;
		this.sway.reset();
	}
}
