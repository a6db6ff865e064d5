/** How long a frame takes until it is there, not until its commands are handed over. */

import type { WebGLRenderer, WebGLRenderTarget } from 'three';

/** Rasterisers that run on the processor: their timer queries tell when commands were taken, not when they were done. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Milliseconds that a turn should last: what a clock of a millisecond's steps still tells apart. */
const TURN = 30;
const MOST_FRAMES = 64;

/** What is used of EXT_disjoint_timer_query_webgl2. */
interface TimerQuery {
	TIME_ELAPSED_EXT: number;
	GPU_DISJOINT_EXT: number;
}

/** The browser's own word on what draws. */
export function deviceOf(renderer: WebGLRenderer): string {
	const gl = renderer.getContext();
	// Firefox answers the plain question at full length, and calls this extension's name out of date.
	const plain = String(gl.getParameter(gl.RENDERER));
	const extension = /^webkit webgl/i.test(plain) ? gl.getExtension('WEBGL_debug_renderer_info') : null;
	return extension ? String(gl.getParameter(extension.UNMASKED_RENDERER_WEBGL)) : plain;
}

/** Lets the page live between two turns. */
export const breath = () => new Promise<void>((resolve) => setTimeout(resolve));

export class Stopwatch {
	readonly device: string;
	readonly #renderer: WebGLRenderer;
	readonly #gl: WebGL2RenderingContext;
	readonly #query: TimerQuery | null;
	readonly #pixel = new Uint16Array(4);

	constructor(renderer: WebGLRenderer) {
		this.#renderer = renderer;
		this.#gl = renderer.getContext() as WebGL2RenderingContext;
		this.device = deviceOf(renderer);
		this.#query = SOFTWARE.test(this.device) ? null : this.#gl.getExtension('EXT_disjoint_timer_query_webgl2');
	}

	get clock(): 'readPixels' | 'timer query' {
		return this.#query ? 'timer query' : 'readPixels';
	}

	/** How many frames a turn has to have, from how long one took. */
	static framesFor(milliseconds: number): number {
		return Math.min(Math.max(Math.ceil(TURN / Math.max(milliseconds, 1e-3)), 1), MOST_FRAMES);
	}

	/**
	 * Milliseconds a frame, over some of them.
	 *
	 * @param target half floats; what the frames are drawn in
	 */
	async time(frame: () => void, frames: number, target: WebGLRenderTarget): Promise<number> {
		for (;;) {
			const time = this.#query ? await this.#elapsed(this.#query, frame, frames) : this.#read(frame, frames, target);
			// A lost context draws nothing, and very fast.
			if (this.#gl.isContextLost()) throw new Error('the graphics context was lost');
			if (time !== undefined) return time;
		}
	}

	#read(frame: () => void, frames: number, target: WebGLRenderTarget): number {
		const start = performance.now();
		for (let i = 0; i < frames; i++) frame();
		this.#renderer.readRenderTargetPixels(target, 0, 0, 1, 1, this.#pixel);
		return (performance.now() - start) / frames;
	}

	/** @returns undefined where the GPU was disturbed and the query says nothing */
	async #elapsed(query: TimerQuery, frame: () => void, frames: number): Promise<number | undefined> {
		const gl = this.#gl;
		const handle = gl.createQuery();
		gl.getParameter(query.GPU_DISJOINT_EXT);
		gl.beginQuery(query.TIME_ELAPSED_EXT, handle);
		for (let i = 0; i < frames; i++) frame();
		gl.endQuery(query.TIME_ELAPSED_EXT);
		gl.flush();
		while (!gl.isContextLost() && !gl.getQueryParameter(handle, gl.QUERY_RESULT_AVAILABLE)) await breath();
		const nanoseconds = Number(gl.getQueryParameter(handle, gl.QUERY_RESULT));
		gl.deleteQuery(handle);
		return gl.getParameter(query.GPU_DISJOINT_EXT) ? undefined : nanoseconds / 1e6 / frames;
	}
}
