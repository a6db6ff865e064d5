/** One WebGL context for all figures: each is drawn into a canvas of its own, while it is on screen and has changed. */

import {
	type Camera,
	DirectionalLight,
	HalfFloatType,
	NeutralToneMapping,
	type Scene,
	UnsignedByteType,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { OutputPass } from 'three/addons/postprocessing/OutputPass.js';
import { limitsOf, type TextureLimits } from '../fur/index.ts';
import { disposeAll } from '../page/dispose.ts';

const MAX_PIXEL_RATIO = 2;
/** Of samples per pixel, where pixels are not small themselves. */
const SAMPLES = 4;
/** Screens before and after the one on show, within which a picture is drawn already. */
export const MARGIN = '50%';

/** A figure's canvas. */
export interface Picture {
	/** Has it drawn anew in the next frame, or as soon as it is on screen. */
	redraw(): void;
	readonly visible: boolean;
	remove(): void;
}

interface Entry extends Picture {
	draw: () => void;
	dirty: boolean;
	/** Whether it has ever been drawn: the first time it is, wherever it is. */
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

	readonly #seen = new IntersectionObserver(
		(changes) => {
			for (const { target, isIntersecting } of changes) {
				const entry = this.#entries.get(target);
				if (entry) entry.visible = isIntersecting;
			}
			this.wake();
		},
		{ rootMargin: MARGIN },
	);

	readonly #sized = new ResizeObserver((changes) => {
		for (const { target } of changes) this.#fit(target as HTMLCanvasElement);
	});

	constructor() {
		this.#output = output();
		const canvas = this.#output?.renderer.domElement;
		canvas?.addEventListener('webglcontextlost', () => {
			// three would later ask the new context to delete what belonged to the old one.
			for (const scene of this.#scenes) forget(scene);
			this.#output?.target.dispose();
			this.#output?.pass.dispose();
		});
		canvas?.addEventListener('webglcontextrestored', () => {
			if (this.#output) this.#output.pass = toScreen();
			for (const entry of this.#entries.values()) entry.redraw();
		});
		// What is printed is whole.
		addEventListener('beforeprint', () => this.#paint(() => true));
	}

	/** Whether nothing is drawn, since something else needs the machine for itself. */
	get paused(): boolean {
		return this.#paused;
	}

	set paused(paused: boolean) {
		this.#paused = paused;
		this.wake();
	}

	/** undefined where there is no WebGL2: three-dimensional figures have to fail then, others go on. */
	get renderer(): WebGLRenderer | undefined {
		return this.#output?.renderer;
	}

	/** What the GPU takes; the most generous where there is none. */
	get limits(): TextureLimits | undefined {
		return this.#output && limitsOf(this.#output.renderer.getContext() as WebGL2RenderingContext);
	}

	/**
	 * @param canvas has its size from style sheets; its pixels are set here
	 * @param draw draws the whole of it, by a 2D context of its own or by `render`
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

	/** Calls `step` before every frame for as long as it returns true; after that, `wake` is wanted for another. */
	animate(step: (elapsed: number) => boolean): void {
		this.#steps.add(step);
		this.wake();
	}

	/** Has a frame drawn where anything is to be drawn. */
	wake(): void {
		if (this.#requested || this.#paused) return;
		this.#requested = true;
		requestAnimationFrame((now) => this.#frame(now));
	}

	/** Fulfilled when every picture in `place` has been drawn as it is wanted now. */
	drawn(place: Element): Promise<void> {
		this.wake();
		return new Promise((resolve) => this.#waiting.push({ place, resolve }));
	}

	#frame(now: number): void {
		this.#requested = false;
		if (this.#paused) return;
		// A frame after a pause is like one after a hiccup.
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
		// On paper a picture stays what it was on screen: there is no next frame to draw it anew.
		if (matchMedia('print').matches) return;
		const ratio = Math.min(devicePixelRatio, MAX_PIXEL_RATIO);
		const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.round(side * ratio));
		// Not shown just now.
		if (!width || !height) return;
		if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
		this.#entries.get(canvas)?.redraw();
	}
}

function forget(scene: Scene): void {
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

/** Fur blends in linear light: into half floats where the GPU has them, and on to the screen from there. */
function output(): Output | undefined {
	const canvas = document.createElement('canvas');
	const attributes: WebGLContextAttributes = { antialias: false, depth: false, powerPreference: 'high-performance' };
	// The renderer complains where there is none; the pages don't.
	const gl = canvas.getContext('webgl2', attributes);
	if (!gl) return undefined;
	const half = gl.getExtension('EXT_color_buffer_float') ?? gl.getExtension('EXT_color_buffer_half_float');
	const renderer = new WebGLRenderer({ canvas, ...attributes });
	renderer.toneMapping = NeutralToneMapping;
	renderer.shadowMap.enabled = true;
	const target = new WebGLRenderTarget(1, 1, {
		type: half ? HalfFloatType : UnsignedByteType,
		samples: devicePixelRatio < 2 ? SAMPLES : 0,
	});
	renderer.setSize(1, 1, false);
	return { renderer, target, pass: toScreen() };
}
