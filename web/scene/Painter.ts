/** One WebGL context for all figures: each is drawn into its own canvas while on screen and changed. */

import {
	type Camera,
	DirectionalLight,
	HalfFloatType,
	type Scene,
	UnsignedByteType,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { OutputPass } from 'three/addons/postprocessing/OutputPass.js';
import { type Fur, type FurLimits, furLimits } from '../fur/index.ts';
import { disposeAll } from '../page/dispose.ts';
import { setToneMapping } from '../page/toneMapping.ts';
import { isWhole } from '../page/webgl.ts';
import { compileScene } from './compile.ts';

const MAX_PIXEL_RATIO = 2;
/** Samples per pixel on screens of low density. */
const SAMPLES = 4;
/** Margin around the window within which pictures are drawn, share of the window. */
export const MARGIN = '50%';

/** A figure's canvas. */
export interface Picture {
	/** Requests a redraw in the next frame, or once on screen. */
	redraw(): void;
	readonly visible: boolean;
	remove(): void;
}

interface Entry extends Picture {
	draw: () => void;
	dirty: boolean;
	/** Whether it has ever been drawn; the first draw happens even off screen. */
	drawn: boolean;
	visible: boolean;
}

interface Output {
	renderer: WebGLRenderer;
	target: WebGLRenderTarget;
	pass: OutputPass;
}

export class Painter {
	readonly #output: Output | undefined;
	readonly #entries = new Map<Element, Entry>();
	readonly #scenes = new Set<Scene>();
	readonly #steps = new Set<(elapsed: number) => boolean>();
	#paused = false;
	#waiting: { place: Element; resolve: () => void }[] = [];
	#requested = false;
	#before = performance.now();

	/** Ends its listeners. */
	readonly #ended = new AbortController();

	readonly #seen: IntersectionObserver;
	readonly #onSeen = (changes: IntersectionObserverEntry[]) => {
		for (const { target, isIntersecting } of changes) {
			const entry = this.#entries.get(target);
			if (entry) entry.visible = isIntersecting;
		}
		this.wake();
	};

	readonly #sized = new ResizeObserver((changes) => {
		for (const { target } of changes) this.#fit(target as HTMLCanvasElement);
	});

	/** @param margin around the window within which pictures are drawn, as of an IntersectionObserver */
	constructor(margin = MARGIN) {
		this.#seen = new IntersectionObserver(this.#onSeen, { rootMargin: margin });
		this.#output = output();
		const canvas = this.#output?.renderer.domElement;
		const { signal } = this.#ended;
		const lost = () => {
			// Free now: later three would ask the new context to delete objects of the old one.
			for (const scene of this.#scenes) free(scene);
			this.#output?.target.dispose();
			this.#output?.pass.dispose();
		};
		const restored = () => {
			if (this.#output) this.#output.pass = toScreen();
			for (const entry of this.#entries.values()) entry.redraw();
		};
		canvas?.addEventListener('webglcontextlost', lost, { signal });
		canvas?.addEventListener('webglcontextrestored', restored, { signal });
		// Printing needs all pictures.
		addEventListener('beforeprint', () => this.#paint(() => true), { signal });
	}

	/** Frees the GPU objects of a scene that is drawn no more. */
	forget(scene: Scene): void {
		free(scene);
		this.#scenes.delete(scene);
	}

	/** Frees all GPU objects, and the context with them. Scenes are forgotten before; nothing is drawn afterwards. */
	dispose(): void {
		this.#ended.abort();
		this.#paused = true;
		this.#seen.disconnect();
		this.#sized.disconnect();
		if (!this.#output) return;
		const { renderer, target, pass } = this.#output;
		target.dispose();
		pass.dispose();
		renderer.dispose();
		// Without this the context lives until the garbage is collected; browsers allow a page few of them.
		renderer.forceContextLoss();
	}

	/** Whether drawing is paused, to leave the machine to a measurement. */
	get paused(): boolean {
		return this.#paused;
	}

	set paused(paused: boolean) {
		this.#paused = paused;
		this.wake();
	}

	/** Renderer; undefined without WebGL2, when only three-dimensional figures fail. */
	get renderer(): WebGLRenderer | undefined {
		return this.#output?.renderer;
	}

	/** Limits of the GPU; undefined without one. */
	get limits(): FurLimits | undefined {
		return this.#output && furLimits(this.#output.renderer.getContext() as WebGL2RenderingContext);
	}

	/**
	 * @param canvas canvas sized by style sheets; its pixels are set here
	 * @param draw draws all of it, by its 2D context or by `render`
	 */
	picture(canvas: HTMLCanvasElement, draw: () => void): Picture {
		const entry: Entry = {
			draw,
			dirty: true,
			drawn: false,
			visible: false,
			redraw: () => {
				entry.dirty = true;
				this.wake();
			},
			remove: () => {
				this.#entries.delete(canvas);
				this.#seen.unobserve(canvas);
				this.#sized.unobserve(canvas);
			},
		};
		this.#entries.set(canvas, entry);
		this.#fit(canvas);
		this.#seen.observe(canvas);
		this.#sized.observe(canvas);
		return entry;
	}

	/** Compiles what a scene needs before it is first drawn. @param furs on show */
	async compile(scene: Scene, camera: Camera, furs: readonly Fur[]): Promise<void> {
		if (this.#output) await compileScene(this.#output.renderer, scene, camera, this.#output.target, furs);
	}

	/** Draws a scene into a 2D canvas, at its full size. */
	render(scene: Scene, camera: Camera, canvas: HTMLCanvasElement): void {
		const { width, height } = canvas;
		if (!this.#output || this.#output.renderer.getContext().isContextLost()) return;
		const { renderer, target, pass } = this.#output;
		this.#scenes.add(scene);
		const whole = renderer.domElement;
		if (whole.width < width || whole.height < height) {
			const [w, h] = [Math.max(whole.width, width), Math.max(whole.height, height)];
			renderer.setSize(w, h, false);
			target.setSize(w, h);
		}
		target.viewport.set(0, 0, width, height);
		target.scissor.set(0, 0, width, height);
		target.scissorTest = true;
		renderer.setRenderTarget(target);
		renderer.render(scene, camera);
		renderer.setScissor(0, 0, width, height);
		renderer.setScissorTest(true);
		pass.render(renderer, target, target, 0, false);
		const context = canvas.getContext('2d');
		context?.clearRect(0, 0, width, height);
		// WebGL counts rows from below.
		context?.drawImage(whole, 0, whole.height - height, width, height, 0, 0, width, height);
	}

	/** Calls `step` before every frame while it returns true; after that `wake` starts it again. */
	animate(step: (elapsed: number) => boolean): void {
		this.#steps.add(step);
		this.wake();
	}

	/** Requests a frame. */
	wake(): void {
		if (this.#requested || this.#paused) return;
		this.#requested = true;
		requestAnimationFrame((now) => this.#frame(now));
	}

	/** Resolves when every picture in `place` is up to date. */
	drawn(place: Element): Promise<void> {
		this.wake();
		return new Promise((resolve) => this.#waiting.push({ place, resolve }));
	}

	#frame(now: number): void {
		this.#requested = false;
		if (this.#paused) return;
		// Bound the time after a pause.
		const elapsed = Math.min((now - this.#before) / 1000, 0.1);
		this.#before = now;
		let moving = false;
		for (const step of this.#steps) if (step(elapsed)) moving = true;
		this.#paint((entry) => entry.visible || !entry.drawn);
		if (moving && [...this.#entries.values()].some(({ visible }) => visible)) this.wake();
	}

	#paint(wanted: (entry: Entry) => boolean): void {
		for (const entry of this.#entries.values()) {
			if (!entry.dirty || !wanted(entry)) continue;
			entry.dirty = false;
			entry.drawn = true;
			entry.draw();
		}
		this.#waiting = this.#waiting.filter(({ place, resolve }) => {
			const waits = [...this.#entries].some(([canvas, { dirty }]) => dirty && place.contains(canvas));
			if (!waits) resolve();
			return waits;
		});
	}

	#fit(canvas: HTMLCanvasElement): void {
		// Printed pictures keep their size: there is no next frame to redraw them.
		if (matchMedia('print').matches) return;
		const ratio = Math.min(devicePixelRatio, MAX_PIXEL_RATIO);
		const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.round(side * ratio));
		// Hidden.
		if (!width || !height) return;
		if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
		this.#entries.get(canvas)?.redraw();
	}
}

function free(scene: Scene): void {
	disposeAll(scene);
	scene.traverse((object) => {
		if (object instanceof DirectionalLight) object.shadow.dispose();
	});
}

function toScreen(): OutputPass {
	const pass = new OutputPass();
	pass.renderToScreen = true;
	return pass;
}

/** Target for blending in linear light: half floats where the GPU has them. */
function output(): Output | undefined {
	const canvas = document.createElement('canvas');
	const attributes: WebGLContextAttributes = { antialias: false, depth: false, powerPreference: 'high-performance' };
	// Asked here, since the renderer would log an error.
	const gl = canvas.getContext('webgl2', attributes);
	if (!isWhole(gl)) return undefined;
	const half = gl.getExtension('EXT_color_buffer_float') ?? gl.getExtension('EXT_color_buffer_half_float');
	const renderer = new WebGLRenderer({ canvas, ...attributes });
	setToneMapping(renderer);
	renderer.shadowMap.enabled = true;
	const target = new WebGLRenderTarget(1, 1, {
		type: half ? HalfFloatType : UnsignedByteType,
		samples: devicePixelRatio < 2 ? SAMPLES : 0,
	});
	renderer.setSize(1, 1, false);
	return { renderer, target, pass: toScreen() };
}
