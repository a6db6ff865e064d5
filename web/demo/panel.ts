/** The small panel: which model, in which place, how many shells, how many bodies. */

import GUI from 'lil-gui';
import { maxCrowd } from './crowd.ts';
import { type EnvironmentName, environments } from './environments.ts';
import type { MenuEntry } from './models.ts';

/** Shells that the slider reaches; the address may ask for more. */
const sliderEnd = 128;

export interface PanelHandlers {
	model(name: string): void;
	environment(name: EnvironmentName | 'none'): void;
	/** @param count undefined: as many as the picture needs */
	shells(count: number | undefined): void;
	crowd(count: number): void;
}

export class Panel {
	readonly #values = {
		model: '',
		environment: 'none' as EnvironmentName | 'none',
		shells: 1,
		automatic: true,
		crowd: 1,
	};
	readonly #gui: GUI;
	readonly #model;
	readonly #environment;
	readonly #automatic;
	readonly #shells;
	readonly #crowd;
	#titles: Record<string, string> = {};

	constructor(container: HTMLElement, handlers: PanelHandlers) {
		this.#gui = new GUI({ container, title: 'Fur' });
		this.#gui.domElement.setAttribute('role', 'group');
		this.#gui.domElement.setAttribute('aria-label', 'Settings');
		this.#model = this.#gui
			.add(this.#values, 'model', [])
			.name('Model')
			.onChange((name: string) => name && handlers.model(name));
		const places = Object.entries(environments).map(([name, title]) => [title, name]);
		this.#environment = this.#gui
			.add(this.#values, 'environment', { None: 'none', ...Object.fromEntries(places) })
			.name('Environment')
			.onChange(handlers.environment);
		this.#automatic = this.#gui
			.add(this.#values, 'automatic')
			.name('Automatic')
			.onChange((automatic: boolean) => {
				handlers.shells(automatic ? undefined : this.#values.shells);
				this.#shells.enable(!automatic);
			});
		this.#shells = this.#gui.add(this.#values, 'shells', 1, sliderEnd, 1).name('Shells').onChange(handlers.shells);
		this.#automatic.disable();
		this.#shells.disable();
		this.#crowd = this.#gui.add(this.#values, 'crowd', 1, maxCrowd, 1).name('Crowd').onChange(handlers.crowd);
		this.#crowd.disable();
		if (matchMedia('(max-width: 620px), (max-height: 420px)').matches) this.#gui.close();
	}

	menu(entries: readonly MenuEntry[]): void {
		this.#titles = Object.fromEntries(entries.map(({ name, title }) => [title, name]));
		this.#model.options(this.#titles);
	}

	/** Shows where the model stands. */
	place(name: EnvironmentName | 'none'): void {
		this.#values.environment = name;
		this.#environment.updateDisplay();
	}

	/**
	 * Shows what is on show.
	 *
	 * @param model a name of the menu, or any other address, which then gets an entry of its own; '' for none
	 * @param fur undefined where the model has none
	 * @param crowd bodies, of which each of several has shells by its size; undefined where there can be one only
	 */
	update(model: string, fur: { shellCount: number; automatic: boolean } | undefined, crowd: number | undefined): void {
		this.#values.model = model;
		if (model && !Object.values(this.#titles).includes(model)) this.#titles[model] = model;
		this.#model.options(model ? this.#titles : { '–': '', ...this.#titles });
		const { shellCount, automatic } = fur ?? { shellCount: 1, automatic: true };
		this.#values.shells = Math.round(shellCount);
		this.#values.automatic = automatic;
		this.#shells.max(Math.max(sliderEnd, shellCount));
		this.#automatic.updateDisplay().enable(fur !== undefined && crowd === 1);
		this.#shells.updateDisplay().enable(fur !== undefined && crowd === 1 && !automatic);
		this.#values.crowd = crowd ?? 1;
		this.#crowd.updateDisplay().enable(crowd !== undefined);
	}
}
