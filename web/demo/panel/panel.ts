/** The panel: a control for each that the table of parameters has, buttons, and why some of them cannot be used. */

import GUI, { type Controller, type NumberController, type OptionController } from 'lil-gui';
import { type Abilities, type Control, FOLDERS, type Folder, type Shown } from '../state/controls.ts';
import { NAMES, type Part, parameters } from '../state/parameters.ts';
import type { View } from '../state/view.ts';
import { words } from '../words/index.ts';

export interface PanelHandlers {
	/** The view on show, from which the controls take their values. */
	view(): View;
	/** A control was used. */
	changed(patch: Partial<View>, part: Part): void;
	/** Buttons, by their words. */
	copy(): void;
	save(): void;
	reset(): void;
	bakedColours(): void;
	clean(): void;
}

/** Titles of a menu, by the values that they stand for. */
export type Menu = readonly { value: string; title: string }[];

interface Row {
	control: Control;
	controller: Controller;
}

export class Panel {
	/** Outermost element, with its title. */
	readonly element: HTMLElement;
	readonly #handlers: PanelHandlers;
	readonly #folders: Record<Folder, GUI>;
	readonly #rows: Row[] = [];
	readonly #menus: Partial<Record<string, { controller: OptionController; offered: string }>> = {};
	readonly #bakedColours: Controller;
	readonly #clean: Controller;
	/** Below the controls of each folder: why some of them cannot be used. */
	readonly #reasons: Record<Folder, HTMLElement>;
	readonly #actions = document.createElement('div');
	/** The button that stays at the end. */
	readonly #last: Element | null;
	#shown: Shown = {
		...{ model: '', env: 'none', shells: 1, colour: ['000000', '000000'] },
		...{ clip: '', time: 0, duration: 0 },
	};

	constructor(container: HTMLElement, handlers: PanelHandlers) {
		this.#handlers = handlers;
		const gui = new GUI({ container, title: words.panel, injectStyles: false });
		this.element = gui.domElement;
		// In Firefox Tab stops at whatever scrolls, and this has no name; clicks would take the arrow keys from the picture.
		gui.$children.tabIndex = -1;
		gui.$children.addEventListener('focus', () => gui.$children.blur());
		gui.domElement.setAttribute('role', 'group');
		gui.domElement.setAttribute('aria-label', words.settings);
		const folders = FOLDERS.map((name) => [name, gui.addFolder(words[name])] as const);
		this.#folders = Object.fromEntries(folders) as Record<Folder, GUI>;
		for (const name of NAMES) {
			const { controls = [], part = 'style' } = parameters[name];
			for (const control of controls) this.#add(control, part);
		}
		const buttons = { bakedColours: () => handlers.bakedColours(), clean: () => handlers.clean() };
		this.#bakedColours = this.#folders.hair.add(buttons, 'bakedColours').name(words.bakedColours);
		this.#clean = this.#folders.weather.add(buttons, 'clean').name(words.clean);
		const reasons = folders.map(([name, folder]) => [name, placeForReason(folder, name)]);
		this.#reasons = Object.fromEntries(reasons) as Record<Folder, HTMLElement>;
		this.#actions.className = 'actions';
		this.#last = null;
		for (const name of ['copy', 'save', 'reset'] as const) this.button(words[name], () => handlers[name]());
		this.#last = this.#actions.lastElementChild;
		gui.$children.append(this.#actions);
		if (matchMedia('(max-width: 880px), (max-height: 440px)').matches) gui.close();
	}

	/** Adds a control, which reads the view and changes it: it has no value of its own. */
	#add(control: Control, part: Part): void {
		const { view, changed } = this.#handlers;
		const get = () => control.get(view(), this.#shown);
		const set = (value: never) => changed(control.set(value, view(), this.#shown), part);
		const bound = Object.defineProperty({ value: get() }, 'value', { get, set });
		const controller = addTo(this.#folders[control.folder], bound, control).name(words[control.label]);
		if (control.kind === 'menu')
			this.#menus[control.label] = { controller: controller as OptionController, offered: '' };
		this.#rows.push({ control, controller });
	}

	/** Adds a button below the folders. */
	button(text: string, pressed: () => void, tip = ''): void {
		const made = document.createElement('button');
		made.type = 'button';
		made.textContent = text;
		made.title = tip;
		made.addEventListener('click', pressed);
		this.#actions.insertBefore(made, this.#last);
	}

	/** Sets the entries of a menu. */
	offer(name: 'model' | 'preset' | 'clip', entries: Menu): void {
		const titles = Object.fromEntries(entries.map(({ value, title }) => [title, value]));
		const menu = this.#menus[name];
		const offered = JSON.stringify(titles);
		if (!menu || menu.offered === offered) return;
		menu.offered = offered;
		menu.controller.options(titles);
	}

	/** Shows the view, enables what makes sense, and says why where something does not. */
	update(shown: Shown, able: Abilities): void {
		this.#shown = shown;
		const view = this.#handlers.view();
		for (const { control, controller } of this.#rows) {
			controller.enable(control.enabled?.(able, view) ?? true);
			controller.show(control.visible?.(view) ?? true);
			if (control.kind === 'slider') {
				const value = control.get(view, shown);
				const most = control.most?.(shown) ?? Math.max(control.range[1], value);
				(controller as NumberController).max(most);
				// It is a field of text beside a bar of the package's own.
				describe(controller.domElement.querySelector('input'), [control.range[0], most, value]);
			}
			if (control.kind === 'choice') {
				const { options } = (controller as OptionController).$select;
				control.names.forEach((name, i) => {
					const option = options[i];
					if (option) option.disabled = !(control.allowed?.(name, able) ?? true);
				});
			}
			if (control.kind === 'colour')
				for (const input of controller.domElement.querySelectorAll('input')) input.disabled = controller._disabled;
			controller.updateDisplay();
		}
		this.#folders.clips.show(able.clips);
		this.#bakedColours.enable(able.fur);
		this.#clean.enable(able.wet || able.dirt);
		this.#explain(able, view);
	}

	/** Shows how far the clip has come. */
	follow(seconds: number): void {
		this.#shown.time = seconds;
		for (const { control, controller } of this.#rows) if (control.label === 'time') controller.updateDisplay();
	}

	#explain({ model, fur, alone, eigen, root, wet, dirt, calm, plays }: Abilities, { method }: View): void {
		const {
			noFur,
			noEigen,
			crowd,
			colourPlane,
			noStates,
			noEigenStates,
			noDirt,
			calm: moveless,
			stillClips,
		} = words.reasons;
		this.#say('body', fur || !model ? '' : noFur);
		this.#say('clips', plays ? '' : stillClips);
		this.#say('light', !fur ? '' : !alone ? crowd : eigen ? '' : noEigen);
		this.#say('hair', fur && !root ? colourPlane : '');
		const dry = method === 'eigen' ? noEigenStates : noStates;
		const missing = !fur || dirt ? '' : wet ? noDirt : dry;
		this.#say('weather', [missing, ...(fur && calm ? [moveless] : [])].filter(Boolean).join(' '));
	}

	#say(folder: Folder, reason: string): void {
		const place = this.#reasons[folder];
		place.textContent = reason;
		place.hidden = reason === '';
	}
}

function addTo(folder: GUI, bound: { value: unknown }, control: Control): Controller {
	const target = bound as { value: never };
	switch (control.kind) {
		case 'slider':
			return folder.add(target, 'value', ...control.range, control.step);
		case 'toggle':
			return folder.add(target, 'value');
		case 'menu':
			return folder.add(target, 'value', []);
		case 'choice': {
			const titles: Partial<Record<string, string>> = words[control.titles];
			return folder.add(target, 'value', Object.fromEntries(control.names.map((name) => [titles[name], name])));
		}
		case 'colour': {
			const controller = folder.addColor(target, 'value');
			// The text beside it has the name already; the swatch is reached by the keyboard, too.
			controller.domElement.querySelector('input[type=color]')?.removeAttribute('tabindex');
			return controller;
		}
	}
}

/** Tells assistive technology what a field of a number takes. @param numbers least, most and present */
function describe(field: Element | null, numbers: [number, number, number]): void {
	field?.setAttribute('role', 'spinbutton');
	for (const [i, name] of ['valuemin', 'valuemax', 'valuenow'].entries())
		field?.setAttribute(`aria-${name}`, String(numbers[i]));
}

/** Place in a folder, whose description it is. */
function placeForReason(folder: GUI, name: Folder): HTMLElement {
	const place = document.createElement('p');
	place.id = `reason-${name}`;
	place.className = 'reason';
	place.hidden = true;
	folder.$children.setAttribute('role', 'group');
	folder.$children.setAttribute('aria-label', words[name]);
	folder.$children.setAttribute('aria-describedby', place.id);
	folder.$children.append(place);
	return place;
}
