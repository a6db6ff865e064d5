/** Frames per second, milliseconds of CPU and, where the timer exists, of GPU; draw calls, triangles and resolution. */

import Stats from 'stats-gl';
import type { Stage } from './scene.ts';
import type { GpuTimer } from './timer.ts';

const pause = 250; // milliseconds between two readings of the counts

export class Overlay {
	readonly #stats = new Stats({ precision: 1 });
	readonly #gpu: InstanceType<typeof Stats.Panel> | undefined;
	readonly #counts = document.createElement('div');
	readonly #stage: Stage;
	readonly #timer: GpuTimer;
	#read = 0;
	#longest = 0;

	/** @param timer whose time is shown; it is read elsewhere */
	constructor(parent: HTMLElement, stage: Stage, timer: GpuTimer) {
		this.#stage = stage;
		this.#timer = timer;
		// Its own timer makes a query per frame, and does not survive a lost context.
		if (timer.works) this.#gpu = this.#stats.addPanel(new Stats.Panel('GPU', '#ff0', '#220'));
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
		this.#showTime(this.#timer.latest);
		const { calls, triangles } = this.#stage.renderer.info.render;
		const resolution = this.#stage.scale < 1 ? `${Math.round(this.#stage.scale * 100)} %` : 'full';
		this.#counts.textContent = `${calls} draw calls · ${triangles.toLocaleString('en')} triangles · ${resolution} resolution`;
	}

	#showTime(time: number): void {
		if (!(time >= 0)) return;
		this.#longest = Math.max(this.#longest, time);
		this.#gpu?.update(time, this.#longest, 1);
		this.#gpu?.updateGraph(time, this.#longest);
	}
}
