/** Frames per second and their milliseconds, of CPU and, where the timer exists, of GPU; what is drawn in them. */

import Stats from 'stats-gl';
import type { Stage } from './scene.ts';
import type { GpuTimer } from './timer.ts';
import type { Words } from './words/index.ts';

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
	/** Of the one body on show; undefined where there are many, or none. */
	shells: { shellCount: number } | undefined;
	#textures = 0;
	readonly #stage: Stage;
	readonly #timer: GpuTimer;
	readonly #words: Words;
	readonly #speed = document.createElement('div');
	readonly #counts = document.createElement('div');
	readonly #fps: Meter;
	readonly #cpu: Meter;
	readonly #gpu: Meter | undefined;
	readonly #whole: Intl.NumberFormat;
	#read = Number.NEGATIVE_INFINITY;
	#frames = 0;
	#busy = 0;

	/** @param timer whose latest time is shown; it is read elsewhere */
	constructor(parent: HTMLElement, stage: Stage, timer: GpuTimer, words: Words, language: string) {
		this.#stage = stage;
		this.#timer = timer;
		this.#words = words;
		this.#whole = new Intl.NumberFormat(language, { maximumFractionDigits: 0 });
		const graphs = document.createElement('div');
		graphs.className = 'graphs';
		graphs.setAttribute('aria-hidden', 'true');
		this.#fps = new Meter(graphs, 'FPS', '#0ff', '#002', 0);
		this.#cpu = new Meter(graphs, 'CPU', '#0f0', '#020', 1);
		if (timer.works) this.#gpu = new Meter(graphs, 'GPU', '#ff0', '#220', 1);
		parent.append(graphs, this.#speed, this.#counts);
	}

	/** @param bytes of all textures of the scene */
	set textures(bytes: number) {
		this.#textures = bytes;
	}

	/**
	 * Draws one frame and measures it.
	 *
	 * @param render draws it
	 * @param interval milliseconds since the one before; NaN after a rest
	 */
	frame(render: () => void, interval: number): void {
		const start = performance.now();
		if (Number.isNaN(interval)) {
			this.#read = start;
			this.#frames = 0;
			this.#busy = 0;
			this.#speed.textContent = '…';
		}
		render();
		const now = performance.now();
		this.#busy += now - start;
		this.#frames++;
		if (now < this.#read + pause) return;
		const { perSecond, milliseconds } = this.#words;
		const time = (now - this.#read) / this.#frames;
		this.#fps.show(1000 / time);
		this.#cpu.show(this.#busy / this.#frames);
		this.#gpu?.show(this.#timer.latest);
		this.#read = now;
		this.#frames = 0;
		this.#busy = 0;
		this.#speed.textContent = `${perSecond(this.#whole.format(1000 / time))} · ${milliseconds(time.toFixed(1))}`;
		this.#count();
	}

	/** Says that no frame is drawn, since nothing moves. */
	rest(): void {
		this.#speed.textContent = this.#words.atRest;
		this.#count();
	}

	#count(): void {
		const { drawCalls, triangles, shellCount, textures, resolution } = this.#words;
		const { calls, triangles: drawn } = this.#stage.renderer.info.render;
		const { shells } = this;
		this.#counts.textContent = [
			drawCalls(this.#whole.format(calls)),
			triangles(this.#whole.format(drawn)),
			...(shells === undefined ? [] : [shellCount(this.#whole.format(Math.ceil(shells.shellCount)))]),
			textures((this.#textures / 2 ** 20).toFixed(1)),
			resolution(Math.round(this.#stage.scale * 100)),
		].join(' · ');
	}
}
