/** The environment around the model, by name. */

import { DEFAULT_LIGHT } from '../../page/light.ts';
import { loadEnvironment } from '../../scene/environment.ts';
import type { Stage } from '../stage/stage.ts';
import type { EnvironmentName, Triple } from '../state/view.ts';

export class Surroundings {
	/** Name of the environment on show. */
	name: EnvironmentName | 'none' = 'none';
	/** Direction to its brightest lamp; undefined for an environment without one. */
	sun: Triple | undefined;
	readonly #stage: Stage;
	#latest = 0;

	constructor(stage: Stage) {
		this.#stage = stage;
	}

	/**
	 * Changes the environment.
	 *
	 * @returns false where another one was asked for meanwhile
	 * @throws Error where it cannot be loaded
	 */
	async change(name: EnvironmentName | 'none'): Promise<boolean> {
		const turn = ++this.#latest;
		const late = () => turn !== this.#latest;
		try {
			const [x, , z] = DEFAULT_LIGHT;
			const environment = name === 'none' ? undefined : await loadEnvironment(name, Math.atan2(z, x));
			if (late()) {
				environment?.background.dispose();
				return false;
			}
			this.#stage.setEnvironment(environment);
			this.sun = environment?.key.direction?.toArray();
			this.name = name;
			return true;
		} catch (error) {
			if (late()) return false;
			throw error;
		}
	}
}
