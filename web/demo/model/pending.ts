/** Changes under way: the page is loading until the whole picture is on show. */

import { setState } from '../../page/element.ts';
import type { Picture } from '../stage/picture.ts';

export class Pending {
	readonly #picture: Picture;
	#count = 0;

	constructor(picture: Picture) {
		this.#picture = picture;
	}

	/** Runs a change that may take long. @returns when its picture is on show */
	async run(change: () => Promise<void>): Promise<void> {
		this.#count++;
		setState('loading');
		await change().finally(() => {
			this.#count--;
		});
		await this.settle();
	}

	/** Waits for the picture, and reports the page's state. */
	async settle(): Promise<void> {
		const { stage } = this.#picture;
		if (this.#count > 0) return;
		if (!stage.model) return setState('failed');
		// Two frames: the first one may still be on its way to the screen.
		await this.#picture.drawn();
		await this.#picture.drawn();
		if (this.#count === 0 && !stage.gl.isContextLost()) setState('ready');
	}
}
