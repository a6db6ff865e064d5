/** Time of a frame until it is drawn, not until its commands are submitted. */

import type { WebGLRenderer, WebGLRenderTarget } from 'three';

/** Rasterisers on the processor: their timer queries measure the submission of commands, not their execution. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Milliseconds of a turn, enough for a clock with steps of a millisecond. */
const TURN = 30;
const MAX_FRAMES = 64;

/** Used part of EXT_disjoint_timer_query_webgl2. */
interface TimerQuery {
	TIME_ELAPSED_EXT: number;
	GPU_DISJOINT_EXT: number;
}

/** Device as reported by the browser. */
export function deviceOf(renderer: WebGLRenderer): string {
	const gl = renderer.getContext();
	// Firefox gives the full name here, and warns about the extension.
	const plain = String(gl.getParameter(gl.RENDERER));
	const extension = /^webkit webgl/i.test(plain) ? gl.getExtension('WEBGL_debug_renderer_info') : null;
	return extension ? String(gl.getParameter(extension.UNMASKED_RENDERER_WEBGL)) : plain;
}

/** Yields to the page between two turns. */
export const breath = () => new Promise<void>((resolve) => setTimeout(resolve));

export class Stopwatch {
	readonly device: string;
	/** Whether the processor draws. */
	readonly software: boolean;
	readonly #renderer: WebGLRenderer;
	readonly #gl: WebGL2RenderingContext;
	readonly #query: TimerQuery | null;
	readonly #pixel = new Uint16Array(4);

	constructor(renderer: WebGLRenderer) {
		this.#renderer = renderer;
		this.#gl = renderer.getContext() as WebGL2RenderingContext;
		this.device = deviceOf(renderer);
		this.software = SOFTWARE.test(this.device);
		this.#query = this.software ? null : this.#gl.getExtension('EXT_disjoint_timer_query_webgl2');
	}

	get clock(): 'readPixels' | 'timer query' {
		return this.#query ? 'timer query' : 'readPixels';
	}

	/** Number of frames of a turn, from the time of one. */
	static framesFor(milliseconds: number): number {
		return Math.min(Math.max(Math.ceil(TURN / Math.max(milliseconds, 1e-3)), 1), MAX_FRAMES);
	}

	/**
	 * Mean milliseconds of some frames.
	 *
	 * @param target target of the frames, half floats
	 */
	async time(frame: () => void, frames: number, target: WebGLRenderTarget): Promise<number> {
		for (;;) {
			const time = this.#query ? await this.#elapsed(this.#query, frame, frames) : this.#read(frame, frames, target);
			// A lost context draws nothing, fast.
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

	/** @returns undefined where the GPU was disturbed and the query is invalid */
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
