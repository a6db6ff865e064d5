/** Graphs of a frame's figures, of stats-gl: fetched by who wants to see them. */

import Stats from 'stats-gl';

/** A figure with its graph. */
export class Graph {
	readonly #panel: InstanceType<typeof Stats.Panel>;
	readonly #caption = document.createElement('figcaption');
	readonly #text: (value: number) => string;
	#longest = 0;

	/** @param text of a value, above its graph; the panel's own is wider than the panel */
	constructor(parent: HTMLElement, colour: string, dark: string, text: (value: number) => string) {
		this.#panel = new Stats.Panel('', colour, dark);
		this.#text = text;
		const figure = document.createElement('figure');
		figure.append(this.#panel.canvas as HTMLCanvasElement, this.#caption);
		parent.append(figure);
	}

	show(value: number): void {
		if (!Number.isFinite(value)) return;
		this.#longest = Math.max(this.#longest, value);
		this.#caption.textContent = this.#text(value);
		this.#panel.updateGraph(value, this.#longest);
	}
}
