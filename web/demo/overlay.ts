/** Frames per second, milliseconds of CPU and, where the timer exists, of GPU; draw calls, triangles and resolution. */

import Stats from 'stats-gl';
import type { Stage } from './scene.ts';
import type { GpuTimer } from './timer.ts';

const pause = 250; // milliseconds between two readings

/** One figure with its graph. */
class Meter {
	readonly #panel: InstanceType<typeof Stats.Panel>;
	readonly #digits: number;
	#longest = 0;

	constructor(parent: HTMLElement, name: string, colour: string, dark: string, digits: number) {
		this.#panel = new Stats.Panel(name, colour, dark);
		this.#digits = digits;
		parent.append(this.#panel.canvas as HTMLCanvasElement);
	}

	show(value: number): void {
		if (!Number.isFinite(value)) return;
		this.#longest = Math.max(this.#longest, value);
		this.#panel.update(value, this.#longest, this.#digits);
		this.#panel.updateGraph(value, this.#longest);
	}
}

/** The panels are those of stats-gl; its own loop makes objects and a GPU query per frame, so this one counts for itself. */
export class Overlay {
	readonly #stage: Stage;
	readonly #timer: GpuTimer;
	readonly #counts = document.createElement('div');
	readonly #fps: Meter;
	readonly #cpu: Meter;
	readonly #gpu: Meter | undefined;
	#read = performance.now();
	#frames = 0;
	#busy = 0;

	/** @param timer whose latest time is shown; it is read elsewhere */
	constructor(parent: HTMLElement, stage: Stage, timer: GpuTimer) {
		this.#stage = stage;
		this.#timer = timer;
		const graphs = document.createElement('div');
		graphs.className = 'graphs';
		graphs.setAttribute('aria-hidden', 'true');
		this.#fps = new Meter(graphs, 'FPS', '#0ff', '#002', 0);
		this.#cpu = new Meter(graphs, 'CPU', '#0f0', '#020', 1);
		if (timer.works) this.#gpu = new Meter(graphs, 'GPU', '#ff0', '#220', 1);
		parent.append(graphs, this.#counts);
	}

	/** Draws one frame and measures it. @param render draws it */
	frame(render: () => void): void {
		const start = performance.now();
		render();
		const now = performance.now();
		this.#busy += now - start;
		this.#frames++;
		if (now < this.#read + pause) return;
		this.#fps.show((this.#frames * 1000) / (now - this.#read));
		this.#cpu.show(this.#busy / this.#frames);
		this.#gpu?.show(this.#timer.latest);
		this.#read = now;
		this.#frames = 0;
		this.#busy = 0;
		const { calls, triangles } = this.#stage.renderer.info.render;
		const shells = this.#stage.shells ? ` · ${Math.ceil(this.#stage.shells)} shells` : '';
		const resolution = this.#stage.scale < 1 ? `${Math.round(this.#stage.scale * 100)} %` : 'full';
		this.#counts.textContent = `${calls} draw calls · ${triangles.toLocaleString('en')} triangles${shells} · ${resolution} resolution`;
	}
}
