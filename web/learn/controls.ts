/** Parts of figures in plain HTML: canvas, sliders, choices, buttons, notes. */

let made = 0;

function add<K extends keyof HTMLElementTagNameMap>(parent: Element, tag: K, className = ''): HTMLElementTagNameMap[K] {
	const element = document.createElement(tag);
	if (className) element.className = className;
	parent.append(element);
	return element;
}

/** Milliseconds without another value after which one is spoken. */
const REST = 400;

/**
 * Canvas as wide as its place. One that takes keys is focusable and more than an image: see `takeKeys`.
 *
 * @param label accessible name
 * @param aspect width over height
 */
export function figureCanvas(place: Element, label: string, aspect: number): HTMLCanvasElement {
	const canvas = add(place, 'canvas');
	canvas.setAttribute('role', 'img');
	canvas.setAttribute('aria-label', label);
	canvas.style.setProperty('--aspect', String(aspect));
	return canvas;
}

/** Row for controls below a picture. */
export function controlRow(place: Element): HTMLElement {
	return add(place, 'div', 'controls');
}

export interface SliderOptions {
	label: string;
	min: number;
	max: number;
	step: number;
	value: number;
	/** Text of the value beside the slider. */
	text: (value: number) => string;
	/** Called on every move, and once at first. */
	input: (value: number) => void;
}

export interface Slider {
	value: number;
	readonly element: HTMLInputElement;
}

export function slider(place: Element, { label, min, max, step, value, text, input }: SliderOptions): Slider {
	const row = add(place, 'div', 'slider');
	const id = `slider-${++made}`;
	const name = add(row, 'label');
	name.htmlFor = id;
	name.textContent = label;
	const range = add(row, 'input');
	Object.assign(range, { id, type: 'range', min, max, step, value });
	const output = add(row, 'output');
	output.htmlFor.add(id);
	const show = () => {
		output.textContent = text(range.valueAsNumber);
		range.setAttribute('aria-valuetext', output.textContent);
		input(range.valueAsNumber);
	};
	range.addEventListener('input', show);
	show();
	return {
		element: range,
		get value() {
			return range.valueAsNumber;
		},
		set value(wanted: number) {
			range.valueAsNumber = wanted;
			show();
		},
	};
}

/** Choice of one, as radio buttons in a row. @param options value → label */
export function choice<T extends string>(
	place: Element,
	label: string,
	options: Readonly<Record<T, string>>,
	value: T,
	change: (value: T) => void,
): HTMLFieldSetElement {
	const set = add(place, 'fieldset', 'choice');
	const legend = add(set, 'legend');
	legend.textContent = label;
	const name = `choice-${++made}`;
	for (const [key, text] of Object.entries(options) as [T, string][]) {
		const item = add(set, 'label');
		const input = add(item, 'input');
		Object.assign(input, { type: 'radio', name, value: key, checked: key === value });
		input.addEventListener('change', () => change(key));
		add(item, 'span').textContent = text;
	}
	change(value);
	return set;
}

/** Button with an action. */
export function action(place: Element, label: string, act: () => void): HTMLButtonElement {
	const button = add(place, 'button', 'action');
	button.type = 'button';
	button.textContent = label;
	button.addEventListener('click', act);
	return button;
}

/** Line of numbers below a figure; `live` announces changes to screen readers. */
export function note(place: Element, live = false): HTMLParagraphElement {
	const line = add(place, 'p', 'note');
	if (live) line.setAttribute('aria-live', 'polite');
	return line;
}

/**
 * Status that is heard, not seen: the value that keys have set on a canvas.
 *
 * @returns function that has a text spoken once keys rest
 */
export function spoken(place: Element): (text: string) => void {
	const status = add(place, 'p', 'hidden');
	status.setAttribute('role', 'status');
	let resting: ReturnType<typeof setTimeout> | undefined;
	return (text) => {
		clearTimeout(resting);
		resting = setTimeout(() => {
			status.textContent = text;
		}, REST);
	};
}

/** Row of pictures side by side. */
export function panes(place: Element, count: number): HTMLElement {
	const row = add(place, 'div', 'panes');
	row.style.setProperty('--panes', String(count));
	return row;
}

/** One picture of a row, with a caption below. */
export function pane(row: Element): { element: HTMLElement; caption: HTMLParagraphElement } {
	const box = add(row, 'div', 'pane');
	const element = add(box, 'div');
	return { element, caption: add(box, 'p') };
}
