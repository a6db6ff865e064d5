/** Tools: the bar and the button that choose what a drag on the picture does. */

import { element } from '../../page/element.ts';

/** In the order of the bar. */
const names = ['light', 'stroke', 'rain', 'mud', 'move'] as const;

export type Tool = (typeof names)[number];

/** Action of a drag: the tool's, or the camera's while its own button is pressed. */
export type DragAction = Tool | 'camera';

export class Tools {
	/** Called when another action is chosen. */
	changed: (act: DragAction) => void = () => {};
	/** Button that lets a drag turn the camera. */
	readonly camera = element<HTMLButtonElement>('orbit');
	readonly #radios: HTMLInputElement[];
	#tool: Tool = 'light';
	#camera = false;

	constructor() {
		const bar = element('tools');
		this.#radios = names.map((name) => bar.querySelector(`[value=${name}]`) as HTMLInputElement);
		for (const radio of this.#radios) radio.addEventListener('change', () => this.choose(radio.value as Tool));
		this.camera.addEventListener('click', () => this.#choose(this.#tool, !this.#camera));
		this.#show();
	}

	/** Action of a drag. */
	get act(): DragAction {
		return this.#camera ? 'camera' : this.#tool;
	}

	choose(tool: Tool): void {
		this.#choose(tool, false);
	}

	/** Shows the tools that can be used; the light replaces one that cannot any more. */
	offer(able: { [Name in Tool]?: boolean }): void {
		for (const radio of this.#radios) (radio.parentElement as HTMLElement).hidden = !able[radio.value as Tool];
		if (!able[this.#tool]) this.#choose('light', this.#camera);
	}

	#choose(tool: Tool, camera: boolean): void {
		if (tool === this.#tool && camera === this.#camera) return;
		this.#tool = tool;
		this.#camera = camera;
		this.#show();
		this.changed(this.act);
	}

	#show(): void {
		this.camera.setAttribute('aria-pressed', String(this.#camera));
		for (const radio of this.#radios) radio.checked = radio.value === this.act;
	}
}
