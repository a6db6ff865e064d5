/** Picture: stage, camera, light and lamp, drawn frame by frame. Knows neither models nor the panel. */

import { Group, type Vector2 } from 'three';
import { FurGovernor } from '../../fur/index.ts';
import { Lamp } from '../../page/lamp/lamp.ts';
import { MovingLight } from '../../page/light.ts';
import type { Room } from '../../page/room.ts';
import type { Triple } from '../state/view.ts';
import { words } from '../words/index.ts';
import { OrbitCamera } from './camera.ts';
import { Frames } from './frames.ts';
import { GpuFrames } from './gpuFrames.ts';
import { textureBytes } from './memory.ts';
import type { Overlay } from './overlay.ts';
import { watchSight, watchSize } from './size.ts';
import { type ShellSpacing, Spacing } from './spacing.ts';
import { Stage } from './stage.ts';

/** Milliseconds after the last move in which the governor restores the full resolution. */
const SETTLING_TIME = 1200;
/** Time constant of the way into another room, seconds; pixels from its end at which it is there. */
const ROOM_EASING = 0.11;
const ROOM_REACHED = 0.3;
const ROOM_SIDES = ['left', 'top', 'width', 'height'] as const;
/** Share of a frame's time that counts while neither light nor camera moves: 30 sharp frames a second show a body breathe. */
const ALIVE = 0.5;
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
	readonly gpu: GpuFrames;
	/** Overlay of figures, if any. */
	overlay: Overlay | undefined;
	/**
	 * Moves animations on by the seconds since the frame before.
	 *
	 * @returns milliseconds until the next frame: 0 at once, Infinity none
	 */
	animate: (elapsed: number) => number = () => Number.POSITIVE_INFINITY;
	/** Takes the spacing of all furs' shells. */
	space: (spacing: ShellSpacing) => void = () => {};
	/** Called when the room of the model has changed. */
	framed: () => void = () => {};
	/** Room that the model stands in, undefined for the whole picture; and the one that it is on the way to, if any. */
	#room: Room | undefined;
	#nextRoom: Room | undefined;
	readonly #waiting: (() => void)[] = [];
	readonly frames = new Frames({
		ready: () => this.gpu.hasRoom() || !this.#inSight,
		draw: (interval, now) => this.#draw(interval, now),
		rest: () => this.#rest(),
	});
	readonly #governor: FurGovernor;
	readonly #spacing = new Spacing();
	readonly #options: PictureOptions;
	/** True while the canvas has another size than the picture. */
	#stale = false;
	#visible = false;
	/** False while the page is scrolled away: nothing moves or is drawn. */
	#inSight = true;
	#moved = Number.NEGATIVE_INFINITY;
	#moving = false;
	/** Milliseconds that this frame has waited for. */
	#wait = 0;
	readonly #render = () => {
		this.gpu.begin();
		this.stage.render(this.camera);
		this.gpu.end();
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
		this.gpu = new GpuFrames(this.stage.gl);
		// In time at 60 Hz, with room for the browser's own work; intervals are 17 ms there at best.
		this.#governor = new FurGovernor({
			merges: true,
			...(this.gpu.timed ? { target: 14 } : { target: 20, capped: true }),
		});
		watchSize(canvas, () => {
			this.#stale = true;
			this.request();
		});
		watchSight(canvas, (inSight) => {
			this.#inSight = inSight;
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
		this.frames.request();
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
		lamp.place(light.direction, stage.centre, stage.lampRadius);
		this.request();
	}

	/** Fits the picture to the canvas, and the camera to the model in its room. */
	fit(): void {
		const { clientWidth: width, clientHeight: height } = this.canvas;
		this.#stale = false;
		this.#visible = width > 0 && height > 0;
		if (!this.#visible) return;
		this.stage.resize(width, height);
		this.#frame();
	}

	#frame(): void {
		if (!this.#visible) return;
		const { clientWidth: width, clientHeight: height } = this.canvas;
		this.camera.frame(this.stage, width, height, this.room);
		this.framed();
		this.request();
	}

	/** Room that the model stands in. */
	get room(): Room {
		const { clientWidth: width, clientHeight: height } = this.canvas;
		return this.#room ?? { left: 0, top: 0, width, height };
	}

	/** Moves the model into another room: gliding, unless it is calm here or the picture has another size, too. */
	enter(room: Room): void {
		const glides = this.#room && !this.calm && !this.#stale && this.stage.model;
		this.#nextRoom = glides ? room : undefined;
		if (!glides) {
			this.#room = { ...room };
			this.#stale = true;
		}
		this.request();
	}

	/** @returns true while the model glides into its room */
	#glide(elapsed: number): boolean {
		const room = this.#room;
		const next = this.#nextRoom;
		if (!room || !next) return false;
		const share = 1 - Math.exp(-elapsed / ROOM_EASING);
		const near = ROOM_SIDES.every((side) => Math.abs(next[side] - room[side]) < ROOM_REACHED);
		if (near) this.#nextRoom = undefined;
		for (const side of ROOM_SIDES) room[side] = near ? next[side] : room[side] + share * (next[side] - room[side]);
		this.#frame();
		return true;
	}

	/** Share of the picture's width left of a share of the room's. */
	columnOf(share: number): number {
		const { left, width } = this.room;
		return (left + share * width) / this.canvas.clientWidth;
	}

	/** Share of the room's width left of a point. @param x in the window, CSS pixels */
	shareAt(x: number): number {
		const { left, width } = this.room;
		return (x - this.canvas.getBoundingClientRect().left - left) / width;
	}

	/** Middle of the room in normalised device coordinates. */
	middle(target: Vector2): Vector2 {
		const { left, top, width, height } = this.room;
		const { clientWidth, clientHeight } = this.canvas;
		return target.set((2 * left + width) / clientWidth - 1, 1 - (2 * top + height) / clientHeight);
	}

	/** Says in `data-box` where the body is in the picture: left, top, width and height. */
	#rest(): void {
		this.overlay?.rest();
		const { canvas, camera, stage } = this;
		if (!stage.model) return;
		const { fur, object } = stage.model;
		const box = camera.boxOnScreen(fur?.skin ?? object, canvas.clientWidth, canvas.clientHeight);
		canvas.dataset.box = ROOM_SIDES.map((side) => Math.round(box[side])).join();
	}

	#draw(interval: number, now: number): number {
		if (!this.#inSight) {
			this.#answer();
			return Number.POSITIVE_INFINITY;
		}
		const { stage, camera, light, lamp, gpu } = this;
		const { still, calm } = this.#options;
		const awake = !Number.isNaN(interval);
		const elapsed = awake ? Math.min(interval / 1000, 0.1) : 1 / 60;
		if (this.#stale) this.fit();
		const entering = this.#glide(elapsed);
		const turning = camera.glide();
		const wandering = light.step(elapsed);
		if (wandering) this.updateLight();
		const wait = this.animate(awake ? Math.min(interval / 1000, MAX_STEP) : 1 / 60);
		if (stage.reframed) {
			stage.reframed = false;
			this.updateLight();
			this.#frame();
		}
		const alive = wait === 0 && !(this.#moving || turning || entering);
		if (wait === 0) this.#moving = true;
		const glowing = lamp.glide(camera, calm ? Number.POSITIVE_INFINITY : elapsed);
		if (this.#moving || turning || entering) this.#moved = now;
		const time = gpu.read();
		// The interval of a frame that waited is not its duration.
		const taken = gpu.timed ? time : this.#wait === 0 ? interval : Number.NaN;
		if (!still) stage.scale = this.#governor.frame(alive ? ALIVE * taken : taken, now, this.#moving);
		this.#moving = false;
		const merging = this.#spacing.glide(this.#governor, elapsed);
		this.space(this.#spacing);
		if (this.#visible && !stage.gl.isContextLost()) {
			if (this.overlay) this.overlay.frame(this.#render, interval);
			else this.#render();
		}
		this.#answer();
		const gliding = entering || turning || wandering || merging;
		const moves = gliding || (glowing && !calm) || (!still && now - this.#moved < SETTLING_TIME);
		this.#wait = moves ? 0 : wait;
		return this.#wait;
	}

	/** Tells those who wait for a frame. */
	#answer(): void {
		while (this.#waiting.length) this.#waiting.pop()?.();
	}

	/** Reports the memory of the scene's textures to the overlay. */
	reportTextureMemory(): void {
		if (this.overlay) this.overlay.textures = textureBytes(this.stage.scene);
	}

	/** Renders the picture to a PNG: at full resolution, the model in its middle, without lamp and ring. */
	async file(): Promise<Blob> {
		if (this.stage.gl.isContextLost()) throw new Error(words.redrawn);
		const room = this.#room;
		this.#room = undefined;
		this.stage.scale = 1;
		this.space({ coarseness: this.#spacing.coarseness, merging: 0 });
		this.guides.visible = false;
		this.#frame();
		this.animate(0);
		this.#render();
		this.guides.visible = true;
		this.#room = room;
		this.#frame();
		// In the same task as the render: later the canvas may be empty.
		return new Promise((resolve, reject) =>
			this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error(words.noPicture)))),
		);
	}
}
