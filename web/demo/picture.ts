/** What is drawn, and when: stage, camera, light and lamp, frame by frame. It knows neither models nor the panel. */

import { Group } from 'three';
import { FurGovernor } from '../fur/index.ts';
import { Lamp } from '../page/lamp.ts';
import { MovingLight } from '../page/light.ts';
import type { Triple } from './address.ts';
import { OrbitCamera } from './camera.ts';
import { Frames } from './frames.ts';
import type { Overlay } from './overlay.ts';
import { Stage } from './scene.ts';
import { watchSize } from './size.ts';
import { GpuTimer } from './timer.ts';

/** Milliseconds after the last movement in which the governor brings back the full resolution. */
const settling = 1200;
/** Seconds that what lives goes on by in a frame, at most: nothing leaps after a hidden tab. */
const longest = 0.25;

export interface PictureOptions {
	/** Nothing moves by itself, and every frame is drawn in full. */
	still: boolean;
	/** Nothing moves by itself, glides or drifts. */
	calm: boolean;
	/** Called whenever a visitor has moved the camera. */
	turned(): void;
}

export class Picture {
	readonly canvas: HTMLCanvasElement;
	readonly stage: Stage;
	readonly camera: OrbitCamera;
	readonly light: MovingLight;
	readonly lamp = new Lamp();
	/** What shows how light and tools stand: no file of the picture has it. */
	readonly guides = new Group();
	readonly timer: GpuTimer;
	/** Figures of the frames; none at first. */
	overlay: Overlay | undefined;
	/**
	 * Moves what lives by the seconds since the frame before.
	 *
	 * @returns milliseconds until it wants another frame: 0 at once, Infinity never
	 */
	live: (elapsed: number) => number = () => Number.POSITIVE_INFINITY;
	/** Called before a frame is drawn, for what the frame looks up. */
	before: () => void = () => {};
	readonly #waiting: (() => void)[] = [];
	readonly #frames = new Frames({
		draw: (interval, now) => this.#draw(interval, now),
		rest: () => this.overlay?.rest(),
	});
	readonly #governor: FurGovernor;
	readonly #options: PictureOptions;
	/** Whether the canvas has another size than the picture; whether it has any. */
	#stale = false;
	#visible = false;
	#moved = Number.NEGATIVE_INFINITY;
	#moving = false;
	/** Milliseconds that the next frame was to wait. */
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
			if (this.camera.chosen) options.turned();
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

	/** Whether nothing moves by itself. */
	get calm(): boolean {
		return this.#options.calm;
	}

	/** Whether every frame is drawn in full, besides. */
	get still(): boolean {
		return this.#options.still;
	}

	request(): void {
		this.#frames.request();
	}

	/** Draws a frame of what is on show now. @returns when it has been drawn, as far as there is a canvas to draw on */
	drawn(): Promise<void> {
		this.request();
		return new Promise((resolve) => this.#waiting.push(resolve));
	}

	/** Has the light come from there at once. */
	shine(direction: Triple, drift: boolean): void {
		this.light.put(direction, drift);
		this.aim();
	}

	/** Brings lamp and light where they belong. */
	aim(): void {
		this.#moving = true;
		const { stage, light, lamp } = this;
		stage.light(light.direction);
		lamp.place(light.direction, stage.centre, stage.radius);
		this.request();
	}

	/** Fits the picture into the canvas, and what is on show into the picture. */
	fit(): void {
		const { clientWidth: width, clientHeight: height } = this.canvas;
		this.#stale = false;
		this.#visible = width > 0 && height > 0;
		if (!this.#visible) return;
		this.stage.resize(width, height);
		this.camera.frame(this.stage.centre, this.stage.radius, width, height, this.stage.closest);
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
		if (wandering) this.aim();
		const wait = this.live(awake ? Math.min(interval / 1000, longest) : 1 / 60);
		if (wait === 0) this.#moving = true;
		const glowing = lamp.glide(camera, calm ? Number.POSITIVE_INFINITY : elapsed);
		if (this.#moving || turning) this.#moved = now;
		const time = timer.read();
		// A frame that waited tells nothing of how long frames take.
		const taken = timer.works ? time : this.#wait === 0 ? interval : Number.NaN;
		if (!still) stage.scale = this.#governor.frame(taken, now, this.#moving);
		this.#moving = false;
		if (this.#visible && !stage.gl.isContextLost()) {
			this.before();
			if (this.overlay) this.overlay.frame(this.#render, interval);
			else this.#render();
		}
		while (this.#waiting.length) this.#waiting.pop()?.();
		const moves = turning || wandering || (glowing && !calm) || (!still && now - this.#moved < settling);
		this.#wait = moves ? 0 : wait;
		return this.#wait;
	}

	/** The picture as a file: at full resolution, and without lamp and ring. */
	async file(): Promise<Blob> {
		if (this.stage.gl.isContextLost()) throw new Error('the picture is being drawn anew, please try again');
		this.stage.scale = 1;
		this.guides.visible = false;
		this.before();
		this.#render();
		this.guides.visible = true;
		this.request();
		// In the same task as the drawing: later the canvas may be empty.
		const blob = await new Promise<Blob | null>((resolve) => this.canvas.toBlob(resolve, 'image/png'));
		if (!blob) throw new Error('the browser made no picture of the canvas');
		return blob;
	}
}
