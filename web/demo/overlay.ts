/** Frames per second, milliseconds of CPU and, where the timer exists, of GPU; draw calls and triangles. */

import Stats from 'stats-gl';
import type { WebGLRenderer } from 'three';

const pause = 250; // milliseconds between two readings of the counts

export class Overlay {
	readonly #stats: Stats;
	readonly #counts = document.createElement('div');
	readonly #renderer: WebGLRenderer;
	#read = 0;

	constructor(parent: HTMLElement, renderer: WebGLRenderer) {
		this.#renderer = renderer;
		const gl = renderer.getContext() as WebGL2RenderingContext;
		const trackGPU = gl.getExtension('EXT_disjoint_timer_query_webgl2') !== null;
		this.#stats = new Stats({ trackGPU, precision: 1 });
		// The bare context: given the renderer it would time the output pass as a frame of its own.
		this.#stats.init(gl);
		// It would fix itself to the corner of the window, above everything.
		this.#stats.dom.style.cssText = 'position: relative';
		const graphs = document.createElement('div');
		graphs.className = 'graphs';
		graphs.setAttribute('aria-hidden', 'true');
		graphs.append(this.#stats.dom);
		parent.append(graphs, this.#counts);
	}

	/** Draws one frame and measures it. @param render draws it */
	frame(render: () => void): void {
		this.#stats.begin();
		render();
		this.#stats.end();
		this.#stats.update();
		const now = performance.now();
		if (now < this.#read + pause) return;
		this.#read = now;
		const { calls, triangles } = this.#renderer.info.render;
		this.#counts.textContent = `${calls} draw calls · ${triangles.toLocaleString('en')} triangles`;
	}
}
