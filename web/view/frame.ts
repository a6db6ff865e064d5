/** Elements in the shadow of a view: canvas, poster, words and controls. */

import css from './style.css?inline';
import type { Words } from './words.ts';

const ICONS = {
	turn: ['M4 12c0-2.2 3.6-4 8-4s8 1.8 8 4-3.6 4-8 4', 'm14.5 13-3 3 3 3'],
	play: ['M8 5.5v13l10-6.5z'],
	pause: ['M8.5 6v12M15.5 6v12'],
	reset: ['M5 12a7 7 0 1 0 2.1-5', 'M4.5 4.5 7 7.2l2.9-2.4'],
} as const;

/** Why there is no picture. */
export interface Failure {
	/** Key of the sentence in the visitor's language. */
	text: 'noWebGL2' | 'notShown';
	/** More of it, in English. */
	reason: string;
}

/** What the element writes into. */
export interface Frame {
	readonly root: HTMLElement;
	readonly canvas: HTMLCanvasElement;
	readonly turn: HTMLButtonElement;
	readonly play: HTMLButtonElement;
	readonly reset: HTMLButtonElement;
	readonly tools: HTMLElement;
	/**
	 * Writes the words; what the page says takes their place.
	 *
	 * @param name what the page says that the picture shows; '' where it is decoration, null where it says nothing
	 * @param failure why there is no picture, if so; read out where it comes later
	 */
	say(words: Words, name: string | null, playing: boolean, failure: Failure | undefined): void;
}

let sheet: CSSStyleSheet | undefined;

/** One style sheet for all views: made by script, as a policy may forbid those in the markup. */
function styles(): CSSStyleSheet {
	if (!sheet) {
		sheet = new CSSStyleSheet();
		sheet.replaceSync(css);
	}
	return sheet;
}

function made<K extends keyof HTMLElementTagNameMap>(tag: K, className: string, ...children: Node[]) {
	const element = document.createElement(tag);
	if (className) element.className = className;
	element.append(...children);
	return element;
}

function slot(name: string, ...children: Node[]): HTMLSlotElement {
	const element = made('slot', '', ...children);
	element.name = name;
	return element;
}

function icon(name: keyof typeof ICONS): SVGSVGElement {
	const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
	svg.setAttribute('viewBox', '0 0 24 24');
	svg.setAttribute('aria-hidden', 'true');
	for (const d of ICONS[name]) {
		const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
		path.setAttribute('d', d);
		svg.append(path);
	}
	return svg;
}

function button(): HTMLButtonElement {
	const element = made('button', '');
	element.type = 'button';
	return element;
}

function label(element: HTMLElement, text: string): void {
	element.ariaLabel = element.title = text;
}

/** Words in the place of a picture that cannot be had. `reach` is called when they have changed. */
function apology() {
	const [sentence, reason] = [made('p', ''), made('p', '')] as const;
	reason.lang = 'en';
	const words = made('div', 'words', slot('fallback', sentence, reason));
	words.setAttribute('role', 'status');
	// Words longer than a small view scroll by keyboard, too.
	const reach = () => {
		if (words.scrollHeight > words.clientHeight) words.tabIndex = 0;
		else words.removeAttribute('tabindex');
	};
	new ResizeObserver(reach).observe(words);
	return { words, sentence, reason, reach };
}

/** Fills an element's shadow. */
export function frame(host: HTMLElement): Frame {
	const shadow = host.attachShadow({ mode: 'open' });
	shadow.adoptedStyleSheets = [styles()];
	const canvas = made('canvas', '');
	// It takes the arrow keys for itself, as on the demo page.
	canvas.setAttribute('role', 'application');
	canvas.setAttribute('aria-describedby', 'hint');
	const hint = made('p', '');
	hint.id = 'hint';
	hint.hidden = true;
	const { words, sentence, reason, reach } = apology();
	const poster = made('div', 'poster', slot('poster'));
	const [turn, play, reset] = [button(), button(), button()] as const;
	turn.append(icon('turn'));
	reset.append(icon('reset'));
	const tools = made('div', 'tools', turn, play, reset);
	tools.setAttribute('role', 'group');
	const root = made('div', 'root', canvas, poster, words, tools, hint);
	shadow.append(root);
	root.addEventListener('slotchange', ({ target }) => {
		const place = target as HTMLSlotElement;
		root.toggleAttribute(`data-${place.name}`, place.assignedNodes().length > 0);
		reach();
	});
	return {
		...{ root, canvas, turn, play, reset, tools },
		say(words, name, playing, failure) {
			const isPicture = name !== '';
			// Without an index it takes no focus at all.
			if (isPicture) canvas.tabIndex = 0;
			else canvas.removeAttribute('tabindex');
			canvas.ariaLabel = name ?? words.label;
			// The poster stands for the picture that cannot be had.
			poster.role = failure && isPicture ? 'img' : null;
			poster.ariaLabel = poster.role && canvas.ariaLabel;
			canvas.ariaHidden = poster.ariaHidden = isPicture ? null : 'true';
			// Words of the element are in its own language, those of the page in the page's.
			for (const own of [hint, tools, sentence]) own.lang = words.lang;
			for (const picture of [canvas, poster]) {
				if (name === null) picture.lang = words.lang;
				else picture.removeAttribute('lang');
			}
			hint.textContent = words.hint;
			label(tools, words.controls);
			label(turn, words.turn);
			label(reset, words.reset);
			label(play, playing ? words.pause : words.play);
			play.replaceChildren(icon(playing ? 'pause' : 'play'));
			sentence.textContent = failure ? words[failure.text] : '';
			reason.textContent = failure?.reason ?? '';
			reach();
		},
	};
}
