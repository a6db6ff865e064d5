/** Overlay of figures: a line of frame rate, time and shells; graphs and what frames draw on demand. */

import type { Graph } from '../say/graphs.ts';
import type { Words } from '../words/index.ts';
import type { GpuFrames } from './gpuFrames.ts';
import type { Stage } from './stage.ts';

const READING_INTERVAL = 250; // milliseconds between two readings

/** Figures, with graphs of stats-gl and a loop of its own: that of stats-gl makes objects and a GPU query per frame. */
export class Overlay {
	/** Shells of the single body; undefined for a crowd, or no fur. */
	shells: { shellCount: number } | undefined;
	#textures = 0;
	readonly #stage: Stage;
	readonly #gpuFrames: GpuFrames;
	readonly #words: Words;
	readonly #speed = document.createElement('span');
	readonly #shellCount = document.createElement('span');
	readonly #more = document.createElement('div');
	readonly #counts = document.createElement('div');
	readonly #switch = document.createElement('button');
	readonly #graphs = document.createElement('div');
	/** Frames per second, time on the CPU and on the GPU, once they have been asked for. */
	#meters: Promise<void> | undefined;
	#fps: Graph | undefined;
	#cpu: Graph | undefined;
	#gpu: Graph | undefined;
	readonly #whole: Intl.NumberFormat;
	#read = Number.NEGATIVE_INFINITY;
	#frames = 0;
	#busy = 0;

	/**
	 * @param gpu shows its latest time; the picture reads it
	 * @param switched called when a visitor wants details, or no more of them
	 */
	constructor(
		parent: HTMLElement,
		{ stage, gpu }: { stage: Stage; gpu: GpuFrames },
		words: Words,
		language: string,
		switched: (details: boolean) => void,
	) {
		this.#stage = stage;
		this.#gpuFrames = gpu;
		this.#words = words;
		this.#whole = new Intl.NumberFormat(language, { maximumFractionDigits: 0 });
		this.#graphs.className = 'graphs';
		this.#graphs.setAttribute('aria-hidden', 'true');
		this.#more.className = 'more';
		this.#more.id = 'figures';
		this.#more.append(this.#graphs, this.#counts);
		this.#switch.type = 'button';
		this.#switch.setAttribute('aria-controls', 'figures');
		this.#switch.addEventListener('click', () => switched(this.#more.hidden === true));
		const line = document.createElement('p');
		line.append(this.#switch, this.#speed, this.#shellCount);
		parent.append(line, this.#more);
		this.details = false;
	}

	/** Shows the details, or the line alone. */
	set details(shown: boolean) {
		// Without a network there are figures without graphs.
		if (shown) this.#meters ??= this.#addGraphs().catch(() => undefined);
		this.#more.hidden = !shown;
		this.#switch.setAttribute('aria-expanded', String(shown));
		this.#switch.setAttribute('aria-label', shown ? this.#words.fewFigures : this.#words.allFigures);
		this.#switch.title = this.#switch.ariaLabel ?? '';
	}

	async #addGraphs(): Promise<void> {
		const { Graph } = await import('../say/graphs.ts');
		const { perSecond, milliseconds } = this.#words;
		const time = (name: string) => (value: number) => `${name} ${milliseconds(value.toFixed(1))}`;
		this.#fps = new Graph(this.#graphs, '#0ff', '#002', (value) => perSecond(this.#whole.format(value)));
		this.#cpu = new Graph(this.#graphs, '#0f0', '#020', time('CPU'));
		if (this.#gpuFrames.timed) this.#gpu = new Graph(this.#graphs, '#ff0', '#220', time('GPU'));
	}

	/** Bytes of all textures of the scene. */
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
		if (now < this.#read + READING_INTERVAL) return;
		const { perSecond, milliseconds } = this.#words;
		const time = (now - this.#read) / this.#frames;
		this.#fps?.show(1000 / time);
		this.#cpu?.show(this.#busy / this.#frames);
		this.#gpu?.show(this.#gpuFrames.latest);
		this.#read = now;
		this.#frames = 0;
		this.#busy = 0;
		this.#speed.textContent = `${perSecond(this.#whole.format(1000 / time))} · ${milliseconds(time.toFixed(1))}`;
		this.#count();
	}

	/** Shows that the picture is at rest. */
	rest(): void {
		this.#speed.textContent = this.#words.atRest;
		this.#count();
	}

	#count(): void {
		const { drawCalls, triangles, shellCount, textures, resolution } = this.#words;
		const { calls, triangles: drawn } = this.#stage.renderer.info.render;
		const { shells } = this;
		this.#shellCount.textContent = shells ? ` · ${shellCount(this.#whole.format(Math.ceil(shells.shellCount)))}` : '';
		this.#counts.textContent = [
			drawCalls(this.#whole.format(calls)),
			triangles(this.#whole.format(drawn)),
			textures((this.#textures / 2 ** 20).toFixed(1)),
			resolution(Math.round(this.#stage.scale * 100)),
		].join(' · ');
	}
}
