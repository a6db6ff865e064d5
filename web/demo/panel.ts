/** The panel: what can be set, and what it is set to. What a control does is up to who made the panel. */

import GUI, { type Controller, type OptionController } from 'lil-gui';
import { type Method, methods } from './address.ts';
import { maxCrowd } from './crowd.ts';
import { type EnvironmentName, environments } from './environments.ts';
import { maxLamps } from './lamps.ts';
import { words } from './words/index.ts';

/** Shells that the slider reaches; the address may ask for more. */
const sliderEnd = 128;

/** What the controls show. */
export interface Settings {
	/** '' for none */
	model: string;
	/** '' for the model's own */
	preset: string;
	crowd: number;
	method: Method;
	split: Method | 'none';
	lights: number;
	environment: EnvironmentName | 'none';
	automatic: boolean;
	shells: number;
	fins: boolean;
	length: number;
	density: number;
	/** sRGB, #rrggbb */
	root: string;
	tip: string;
	/** 0..1; degrees from the first camera's side by way of the right */
	wind: number;
	direction: number;
	/** of all of the fur, 0..1 */
	wetness: number;
	dirt: number;
	turntable: boolean;
}

/** What can be done with what is on show. */
export interface Abilities {
	fur: boolean;
	fins: boolean;
	/** Whether it has light curves of its own kind. */
	eigen: boolean;
	/** Whether the root has one colour everywhere. */
	root: boolean;
	/** What it can be shown in beside dry and clean. */
	states: { wet: boolean; dirt: boolean };
	/** Whether nothing moves by itself. */
	calm: boolean;
}

export type Changed = <Name extends keyof Settings>(name: Name, value: Settings[Name]) => void;

export interface PanelHandlers {
	changed: Changed;
	/** Buttons, by their words. */
	copy(): void;
	save(): void;
	reset(): void;
	bakedColours(): void;
	clean(): void;
}

type Folder = 'body' | 'light' | 'hair' | 'weather';

/** Titles of a menu, by the values that they stand for. */
export type Menu = readonly { value: string; title: string }[];

export class Panel {
	/** What the controls show. */
	readonly settings: Settings = {
		...{ model: '', preset: '', crowd: 1, method: 'ptm', split: 'none', lights: 1, environment: 'none' },
		...{ automatic: true, shells: 1, fins: true, length: 1, density: 1, root: '#000000', tip: '#000000' },
		...{ wind: 0, direction: 0, wetness: 0, dirt: 0, turntable: false },
	};
	readonly #controls: { [Name in keyof Settings]: Controller };
	readonly #baked: Controller;
	readonly #clean: Controller;
	readonly #offered = { model: '', preset: '' };
	/** Below the controls of each folder: why some of them can't be used. */
	readonly #reasons: Record<Folder, HTMLElement>;
	readonly #actions = document.createElement('div');
	/** The button that stays at the end. */
	readonly #last: Element | null = null;

	constructor(container: HTMLElement, handlers: PanelHandlers) {
		const gui = new GUI({ container, title: words.panel, injectStyles: false });
		gui.domElement.setAttribute('role', 'group');
		gui.domElement.setAttribute('aria-label', words.settings);
		const settings = this.settings;
		const add = (folder: GUI, name: keyof Settings, first?: number | object, most?: number, step?: number) =>
			folder
				.add(settings, name, first, most, step)
				.name(words[name])
				.onChange((value: never) => handlers.changed(name, value));
		const body = gui.addFolder(words.body);
		const light = gui.addFolder(words.light);
		const hair = gui.addFolder(words.hair);
		const weather = gui.addFolder(words.weather);
		const named = (names: readonly (Method | 'none')[]) =>
			Object.fromEntries(names.map((name) => [name === 'none' ? words.none : words.methods[name], name]));
		const places = (['none', ...environments] as const).map((name) => [words.environments[name], name]);
		this.#controls = {
			model: add(body, 'model', []),
			preset: add(body, 'preset', []),
			crowd: add(body, 'crowd', 1, maxCrowd, 1),
			method: add(light, 'method', named(methods)),
			split: add(light, 'split', named(['none', ...methods])),
			lights: add(light, 'lights', 1, maxLamps, 1),
			environment: add(light, 'environment', Object.fromEntries(places)),
			automatic: add(hair, 'automatic'),
			shells: add(hair, 'shells', 1, sliderEnd, 1),
			fins: add(hair, 'fins'),
			length: add(hair, 'length', 0.2, 1.5, 0.01),
			density: add(hair, 'density', 0.2, 2, 0.01),
			root: this.#colour(hair, 'root', handlers),
			tip: this.#colour(hair, 'tip', handlers),
			wind: add(weather, 'wind', 0, 1, 0.01),
			direction: add(weather, 'direction', 0, 360, 1),
			wetness: add(weather, 'wetness', 0, 1, 0.01),
			dirt: add(weather, 'dirt', 0, 1, 0.01),
			turntable: add(weather, 'turntable'),
		};
		const buttons = { bakedColours: () => handlers.bakedColours(), clean: () => handlers.clean() };
		this.#baked = hair.add(buttons, 'bakedColours').name(words.bakedColours);
		this.#clean = weather.add(buttons, 'clean').name(words.clean);
		const reason = (folder: GUI) => {
			const place = document.createElement('p');
			place.className = 'reason';
			place.hidden = true;
			folder.$children.append(place);
			return place;
		};
		this.#reasons = { body: reason(body), light: reason(light), hair: reason(hair), weather: reason(weather) };
		this.#actions.className = 'actions';
		for (const name of ['copy', 'save', 'reset'] as const) this.button(words[name], () => handlers[name]());
		this.#last = this.#actions.lastElementChild;
		gui.$children.append(this.#actions);
		if (matchMedia('(max-width: 880px), (max-height: 440px)').matches) gui.close();
	}

	#colour(folder: GUI, name: 'root' | 'tip', handlers: PanelHandlers): Controller {
		const controller = folder.addColor(this.settings, name).name(words[name]);
		// The text beside it has the name already; the swatch is reached by the keyboard, too.
		controller.domElement.querySelector('input[type=color]')?.removeAttribute('tabindex');
		return controller.onChange((value: string) => handlers.changed(name, value));
	}

	/** One more button below the folders. */
	button(text: string, pressed: () => void, tip = ''): void {
		const made = document.createElement('button');
		made.type = 'button';
		made.textContent = text;
		made.title = tip;
		made.addEventListener('click', pressed);
		this.#actions.insertBefore(made, this.#last);
	}

	/** What a menu offers. */
	offer(name: 'model' | 'preset', menu: Menu): void {
		const titles = Object.fromEntries(menu.map(({ value, title }) => [title, value]));
		const key = JSON.stringify(titles);
		if (this.#offered[name] === key) return;
		this.#offered[name] = key;
		(this.#controls[name] as OptionController).options(titles);
	}

	/** Shows how things are, lets through what makes sense, and says why where something does not. */
	update(settings: Settings, { fur, fins, eigen, root, states, calm }: Abilities): void {
		Object.assign(this.settings, settings);
		const controls = this.#controls;
		controls.shells.max(Math.max(sliderEnd, settings.shells));
		const alone = settings.crowd <= 1;
		for (const name of ['preset', 'crowd', 'method', 'length', 'density', 'tip'] as const) controls[name].enable(fur);
		controls.split.enable(fur && alone);
		controls.automatic.enable(fur && alone);
		controls.shells.enable(fur && alone && !settings.automatic);
		// How many it are by itself changes with every zoom: the overlay tells.
		controls.shells.show(!settings.automatic);
		controls.fins.enable(fins);
		controls.root.enable(fur && root);
		for (const name of ['root', 'tip'] as const)
			for (const input of controls[name].domElement.querySelectorAll('input'))
				input.disabled = controls[name]._disabled;
		this.#baked.enable(fur);
		for (const name of ['wind', 'direction'] as const) controls[name].enable(fur);
		controls.wetness.enable(states.wet);
		controls.dirt.enable(states.dirt);
		this.#clean.enable(states.wet || states.dirt);
		controls.turntable.enable(Boolean(settings.model) && alone && !calm);
		for (const name of ['method', 'split'] as const) {
			const { options } = (controls[name] as OptionController).$select;
			for (const option of options) {
				const method = methods.find((own) => words.methods[own] === option.text);
				const rival = method !== undefined && method !== 'ptm' && method !== 'eigen';
				option.disabled = (method === 'eigen' && !eigen) || (rival && !alone);
			}
		}
		const { noFur, noEigen, crowd, colourPlane } = words.reasons;
		const { noStates, noEigenStates, noDirt, calm: moveless } = words.reasons;
		this.#say('body', fur || !settings.model ? '' : noFur);
		this.#say('light', !fur ? '' : !alone ? crowd : eigen ? '' : noEigen);
		this.#say('hair', fur && !root ? colourPlane : '');
		const dry = settings.method === 'eigen' ? noEigenStates : noStates;
		const missing = !fur || states.dirt ? '' : states.wet ? noDirt : dry;
		this.#say('weather', [missing, ...(fur && calm ? [moveless] : [])].filter(Boolean).join(' '));
		for (const controller of Object.values(controls)) controller.updateDisplay();
	}

	#say(folder: Folder, reason: string): void {
		const place = this.#reasons[folder];
		place.textContent = reason;
		place.hidden = reason === '';
	}
}
