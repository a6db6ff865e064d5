/** What lives on the body on show: its hairs' motion, what they are wet with and soiled by, and how the body itself moves. */

import { DataTexture, FloatType, MathUtils, RGBAFormat, type Vector3 } from 'three';
import { FOLLICLES_PER_ROW, FurMotion, FurWeather } from '../fur/index.ts';
import type { View } from './address.ts';
import type { Looks } from './looks.ts';
import { notice, withdraw } from './notice.ts';
import type { Stage } from './scene.ts';
import { Sway } from './sway.ts';
import { words } from './words/index.ts';

/** How much the wind varies, share of its strength. */
const gusts = 0.7;
/** Seconds until soaked fur is dry; milliseconds between two frames in which nothing happens but that. */
const drying = 90;
const slow = 100;

export class Living {
	/** Of the body as a whole. */
	readonly sway = new Sway();
	readonly #looks: Looks;
	readonly #stage: Stage;
	readonly #calm: boolean;
	#motion: FurMotion | undefined;
	#weather: FurWeather | undefined;
	/** Of hairs that stand still: for the next frame, and of the last one. */
	#rehearsal: DataTexture | undefined;
	#rehearsed: DataTexture | undefined;

	/** @param calm nothing moves by itself: wind bends the hairs and stays, and the table does not turn */
	constructor(looks: Looks, stage: Stage, calm: boolean) {
		this.#looks = looks;
		this.#stage = stage;
		this.#calm = calm;
	}

	/** Whether something was painted that no link tells of. */
	get marked(): boolean {
		return this.#weather?.painted ?? false;
	}

	/**
	 * Fetches what the fur is like when it is wet and dirty; where that fails, says why and takes it out of the view.
	 *
	 * @returns whether it is there
	 */
	async load(view: View): Promise<boolean> {
		try {
			await this.#looks.loadStates();
			withdraw('states');
			return true;
		} catch (error) {
			Object.assign(view, { wet: undefined, dirt: undefined });
			notice(words.statesNotShown((error as Error).message), 'error', 'states');
			return false;
		}
	}

	/** Has wind, wetness, dirt and turntable be as the view says. Each is made when it is first needed. */
	style({ wind: [strength, direction] = [0, 0], wet = 0, dirt = 0, turn, crowd = 1 }: View): void {
		const alone = crowd <= 1;
		if (!alone) this.#stand();
		this.sway.turning = Boolean(turn) && alone && !this.#calm;
		if (strength > 0 || this.#motion) this.#blow(strength, MathUtils.degToRad(direction));
		if (wet > 0 || dirt > 0 || this.#weather) this.#wet(wet, dirt);
	}

	#blow(strength: number, direction: number): void {
		const motion = this.#moving();
		if (!motion) return;
		const { wind } = motion;
		const [x, z] = [Math.sin(direction), Math.cos(direction)];
		if (strength === wind.strength && x === wind.direction.x && z === wind.direction.z) return;
		wind.strength = strength;
		wind.direction.set(x, 0, z);
		wind.gusts = this.#calm ? 0 : gusts;
		if (this.#calm) motion.settle();
	}

	#wet(wet: number, dirt: number): void {
		const weather = this.#staining();
		if (!weather) return;
		weather.wetness = wet;
		weather.dirt = dirt;
	}

	#moving(): FurMotion | undefined {
		const { body } = this.#looks;
		if (body) this.#motion ??= new FurMotion(body, { renderer: this.#stage.renderer });
		return this.#motion;
	}

	#staining(): FurWeather | undefined {
		const { body, states } = this.#looks;
		if (body && (states.wet || states.dirt)) this.#weather ??= new FurWeather(body, { drying });
		return this.#weather;
	}

	/** Has the next frame drawn as if hairs moved, at rest: so what that needs is compiled before the first stroke. */
	rehearse(): void {
		const { body } = this.#looks;
		if (!body || this.#motion) return;
		const rows = Math.ceil(body.follicles.count / FOLLICLES_PER_ROW);
		const still = new Float32Array(4 * FOLLICLES_PER_ROW * rows);
		this.#rehearsal = new DataTexture(still, FOLLICLES_PER_ROW, rows, RGBAFormat, FloatType);
		this.#rehearsal.needsUpdate = true;
	}

	/** A finger goes over the fur. Points on the skin and radius are the world's. */
	stroke(from: Vector3, to: Vector3, radius: number): void {
		this.#moving()?.stroke(from, to, radius);
	}

	/** @param amount 0..1: wet through */
	rain(point: Vector3, radius: number, amount: number): void {
		this.#staining()?.rain(point, radius, amount);
	}

	/** @param amount 0..1: all muddy */
	mud(point: Vector3, radius: number, amount: number): void {
		this.#staining()?.mud(point, radius, amount);
	}

	/** Dry and clean at once. */
	clean(): void {
		this.#weather?.clean();
	}

	/** As baked, and at rest. */
	reset(): void {
		this.clean();
		this.#stand();
		this.#motion?.reset();
	}

	/** Has the body in its place at once. */
	#stand(): void {
		this.sway.reset();
		this.#stage.place(this.sway.offset, this.sway.yaw);
	}

	/**
	 * Goes on by so many seconds.
	 *
	 * @returns milliseconds until another frame is wanted: 0 at once, Infinity none
	 */
	step(seconds: number): number {
		const { sway } = this;
		const swung = sway.step(seconds);
		if (swung) {
			this.#stage.place(sway.offset, sway.yaw);
			this.#moving();
		}
		const moved = this.#motion?.update(seconds) ?? false;
		this.#weather?.update(seconds);
		this.#rehearsed?.dispose();
		this.#rehearsed = this.#rehearsal;
		this.#rehearsal = undefined;
		this.#looks.live(this.#motion?.swing ?? this.#rehearsed, this.#weather);
		if (swung || moved || this.#rehearsed) return 0;
		return this.#weather?.drying ? slow : Number.POSITIVE_INFINITY;
	}

	/** To be called while the context is lost: motion begins anew. */
	forget(): void {
		this.#motion?.dispose();
		this.#rehearsed?.dispose();
		this.#motion = this.#rehearsal = this.#rehearsed = undefined;
		this.#looks.live(undefined, this.#weather);
	}

	/** To be called before the body is disposed of. */
	strip(): void {
		this.forget();
		this.#looks.live(undefined, undefined);
		this.#weather?.dispose();
		this.#weather = undefined;
		this.sway.reset();
	}
}
