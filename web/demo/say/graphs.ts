/** Graphs of a frame's figures, of stats-gl: fetched by who wants to see them. */

import Stats from 'stats-gl';

/** A figure with its graph. */
export class Graph {
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
