/** Progress bar of the files of a model. */

import { LoadingManager } from 'three';

export class Progress {
	readonly #bar: HTMLProgressElement;
	#latest: LoadingManager | undefined;

	constructor(bar: HTMLProgressElement) {
		this.#bar = bar;
	}

	/** Starts at zero. @returns the manager to load the files with */
	begin(): LoadingManager {
		const manager = new LoadingManager();
		this.#latest = manager;
		this.#bar.removeAttribute('value');
		this.#bar.max = 1;
		let most = 0;
		manager.onProgress = (_url, loaded, total) => {
			if (manager !== this.#latest) return;
			// The first file names the others: the bar does not go back when they are counted.
			most = Math.max(most, total > 1 ? loaded / total : 0);
			this.#bar.value = most;
		};
		return manager;
	}
}
