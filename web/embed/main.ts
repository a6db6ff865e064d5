/** Page of the tag: views to try, and the text that makes them. */

import { element, setState } from '../page/element.ts';
import { fillHeader } from '../page/header.ts';
import { fillIn, languageOf } from '../page/language.ts';
import { copy } from '../page/share.ts';
import type { FurView } from '../view/view.d.ts';
import { filesOf, SCRIPT, tagOf } from './tag.ts';
import { WORDS } from './words/index.ts';

const language = languageOf(location.search, navigator.languages);
const words = WORDS[language];
fillIn(words, language);
fillHeader(element('site'), 'embed', language);

const said = element('said');

/** Fills a place with text and a button that copies it. @param what of which picture it is; @returns what changes the text */
function copyable(place: HTMLElement, what: string): (text: string) => void {
	const [pre, code, button] = [
		document.createElement('pre'),
		document.createElement('code'),
		document.createElement('button'),
	];
	pre.append(code);
	button.type = 'button';
	const show = (text: string) => {
		button.textContent = text;
		button.setAttribute('aria-label', words.about(text, what));
	};
	show(words.copy);
	button.addEventListener('click', async () => {
		const result = (await copy(code.textContent ?? '')) ? words.copied : words.notCopied;
		show(result);
		said.textContent = words.about(result, what);
		setTimeout(() => {
			show(words.copy);
			// The same words a second time are news again.
			said.textContent = '';
		}, 2000);
	});
	place.append(pre, button);
	return (text) => {
		code.textContent = text;
	};
}

/** Choices of a menu, the first for none. */
function fillMenu(menu: HTMLSelectElement, none: string, names: Readonly<Record<string, string>>): void {
	menu.append(new Option(none, ''), ...Object.entries(names).map(([value, name]) => new Option(name, value)));
}

for (const view of document.querySelectorAll<FurView>('fur-view')) {
	const { alt = '' } = view.dataset;
	const text = String((words as Record<string, unknown>)[alt]);
	view.setAttribute('alt', text);
	const place = document.querySelector<HTMLElement>(`.copy[data-for="${view.id}"]`);
	if (!place) continue;
	const write = copyable(place, text);
	const files = place.parentElement?.insertBefore(document.createElement('p'), place.nextSibling);
	if (files) files.className = 'quiet files';
	const update = () => {
		write(tagOf(view.attributes));
		if (files) files.textContent = words.files(filesOf(view.attributes).join(', '));
	};
	new MutationObserver(update).observe(view, { attributes: true });
	update();
}

const shown = element<FurView>('try');
const [preset, environment] = [element<HTMLSelectElement>('preset'), element<HTMLSelectElement>('environment')];
fillMenu(preset, words.own, words.presets);
fillMenu(environment, words.none, words.places);

/** Sets an attribute, or takes it away where it says nothing. */
function set(name: string, value: string): void {
	if (value) shown.setAttribute(name, value);
	else shown.removeAttribute(name);
}

preset.addEventListener('change', () => set('preset', preset.value));
environment.addEventListener('change', () => {
	set('environment', environment.value);
	// The place has a lamp of its own.
	if (environment.value) shown.removeAttribute('light');
});
const controls = element<HTMLInputElement>('controls');
controls.addEventListener('change', () => shown.toggleAttribute('controls', controls.checked));
element('form').addEventListener('submit', (event) => event.preventDefault());

copyable(element('lines'), words.stepTag)(`${SCRIPT}\n<fur-view src="models/my/model.gltf" controls></fur-view>`);

/** Says how heavy the file is, as this host sends it. */
function weigh(): void {
	const [file] = performance.getEntriesByName(element<HTMLAnchorElement>('file').href) as PerformanceResourceTiming[];
	if (file?.encodedBodySize) element('size').textContent = words.size(Math.round(file.encodedBodySize / 1000));
}

function settle(): void {
	if (shown.state !== 'ready' && shown.state !== 'failed') return;
	setState(shown.state);
	weigh();
}

shown.addEventListener('ready', settle);
shown.addEventListener('error', settle);
settle();
