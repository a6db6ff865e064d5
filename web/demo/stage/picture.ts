/** Picture: stage, camera, light and lamp, drawn frame by frame. Knows neither models nor the panel. */

import { Group } from 'three';
import { FurGovernor } from '../../fur/index.ts';
import { Lamp } from '../../page/lamp.ts';
import { MovingLight } from '../../page/light.ts';
import type { Triple } from '../state/view.ts';
import { OrbitCamera } from './camera.ts';
import { Frames } from './frames.ts';
import { textureBytes } from './memory.ts';
import type { Overlay } from './overlay.ts';
import { watchSize } from './size.ts';
import { Stage } from './stage.ts';
import { GpuTimer } from './timer.ts';

/** Milliseconds after the last move in which the governor restores the full resolution. */
const SETTLING_TIME = 1200;
/** Longest time step of animations, seconds: nothing leaps after a hidden tab. */
const MAX_STEP = 0.25;

export interface PictureOptions {
	/** True: every frame is drawn at full resolution. */
	still: boolean;
	/** True: nothing moves by itself, glides or drifts. */
	calm: boolean;
	/** Called with the orbit after a visitor has moved the camera. */
	turned(orbit: Triple): void;
}

export class Picture {
	readonly canvas: HTMLCanvasElement;
	readonly stage: Stage;
	readonly camera: OrbitCamera;
	readonly light: MovingLight;
	readonly lamp = new Lamp();
	/** Lamp and ring of the brush, left out of saved pictures. */
	readonly guides = new Group();
	readonly timer: GpuTimer;
	/** Overlay of figures, if any. */
	overlay: Overlay | undefined;
	/**
	 * Moves animations on by the seconds since the frame before.
	 *
	 * @returns milliseconds until the next frame: 0 at once, Infinity none
	 */
	animate: (elapsed: number) => number = () => Number.POSITIVE_INFINITY;
	readonly #waiting: (() => void)[] = [];
	readonly #frames = new Frames({
		draw: (interval, now) => this.#draw(interval, now),
		rest: () => this.overlay?.rest(),
	});
	readonly #governor: FurGovernor;
	readonly #options: PictureOptions;
	/** True while the canvas has another size than the picture. */
	#stale = false;
	#visible = false;
	#moved = Number.NEGATIVE_INFINITY;
	#moving = false;
	/** Milliseconds that this frame has waited for. */
	#wait = 0;
	readonly #render = () => {
		this.timer.begin();
		this.stage.render(this.camera);
		this.timer.end();
	};

	constructor(canvas: HTMLCanvasElement, options: PictureOptions) {
		this.canvas = canvas;
		this.#options = options;
		this.stage = new Stage(canvas);
		this.camera = new OrbitCamera(canvas, options.calm, () => {
			this.#moving = true;
			this.request();
			if (this.camera.chosen) options.turned(this.camera.orbit);
		});
		this.light = new MovingLight(!options.calm);
		this.lamp.visible = false;
		this.stage.scene.add(this.guides.add(this.lamp));
		this.timer = new GpuTimer(this.stage.gl);
		// In time at 60 Hz, with room for the browser's own work; intervals are 17 ms there at best.
		this.#governor = new FurGovernor(this.timer.works ? { target: 14 } : { target: 20, capped: true });
		watchSize(canvas, () => {
			this.#stale = true;
			this.request();
		});
	}

	/** True: nothing moves by itself. */
	get calm(): boolean {
		return this.#options.calm;
	}

	/** True: every frame is drawn at full resolution. */
	get still(): boolean {
		return this.#options.still;
	}

	request(): void {
		this.#frames.request();
	}

	/** Draws a frame. @returns once it has been drawn, or skipped for want of a canvas */
	drawn(): Promise<void> {
		this.request();
		return new Promise((resolve) => this.#waiting.push(resolve));
	}

	/** Puts the light there at once. */
	setLight(direction: Triple, drift: boolean): void {
		this.light.put(direction, drift);
		this.updateLight();
	}

	/** Applies the light's direction to the stage and the lamp. */
	updateLight(): void {
		this.#moving = true;
		const { stage, light, lamp } = this;
		stage.setLight(light.direction);
		lamp.place(light.direction, stage.centre, stage.radius);
		this.request();
	}

	/** Fits the picture to the canvas, and the camera to the model. */
	fit(): void {
		const { clientWidth: width, clientHeight: height } = this.canvas;
		this.#stale = false;
		this.#visible = width > 0 && height > 0;
		if (!this.#visible) return;
		this.stage.resize(width, height);
		this.camera.frame(this.stage.centre, this.stage.radius, width, height, this.stage.bodyRadius);
		this.request();
	}

	#draw(interval: number, now: number): number {
		const { stage, camera, light, lamp, timer } = this;
		const { still, calm } = this.#options;
		const awake = !Number.isNaN(interval);
		const elapsed = awake ? Math.min(interval / 1000, 0.1) : 1 / 60;
		if (this.#stale) this.fit();
		const turning = camera.glide();
		const wandering = light.step(elapsed);
		if (wandering) this.updateLight();
		const wait = this.animate(awake ? Math.min(interval / 1000, MAX_STEP) : 1 / 60);
		if (wait === 0) this.#moving = true;
		const glowing = lamp.glide(camera, calm ? Number.POSITIVE_INFINITY : elapsed);
		if (this.#moving || turning) this.#moved = now;
		const time = timer.read();
		// The interval of a frame that waited is not its duration.
		const taken = timer.works ? time : this.#wait === 0 ? interval : Number.NaN;
		if (!still) stage.scale = this.#governor.frame(taken, now, this.#moving);
		this.#moving = false;
		if (this.#visible && !stage.gl.isContextLost()) {
			if (this.overlay) this.overlay.frame(this.#render, interval);
			else this.#render();
		}
		while (this.#waiting.length) this.#waiting.pop()?.();
		const moves = turning || wandering || (glowing && !calm) || (!still && now - this.#moved < SETTLING_TIME);
		this.#wait = moves ? 0 : wait;
		return this.#wait;
	}

	/** Reports the memory of the scene's textures to the overlay. */
	reportTextureMemory(): void {
		if (this.overlay) this.overlay.textures = textureBytes(this.stage.scene);
	}

	/** Renders the picture to a PNG: at full resolution, without lamp and ring. */
	async file(): Promise<Blob> {
		if (this.stage.gl.isContextLost()) throw new Error('the picture is being drawn anew, please try again');
		this.stage.scale = 1;
		this.guides.visible = false;
		this.animate(0);
		this.#render();
		this.guides.visible = true;
		this.request();
		// In the same task as the render: later the canvas may be empty.
		const blob = await new Promise<Blob | null>((resolve) => this.canvas.toBlob(resolve, 'image/png'));
		if (!blob) throw new Error('the browser made no picture of the canvas');
		return blob;
	}
}
