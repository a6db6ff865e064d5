/** Notices above the picture. */

import { words } from '../words/index.ts';

const READING_TIME = 9000; // milliseconds, at least
const LETTER_TIME = 60; // per letter
/** Notices at a time: an older one makes room. */
const MOST = 3;

/**
 * @param kind `note` goes by itself; `advice`, to be followed, and `error` stay until they are closed
 * @param about subject: the next notice on the same one replaces it
 * @returns removes the notice
 */
export function notice(text: string, kind: 'note' | 'advice' | 'error' = 'note', about = ''): () => void {
	withdraw(about);
	const box = document.createElement('div');
	box.className = `notice ${kind}`;
	box.dataset.about = about;
	const sentence = document.createElement('p');
	sentence.textContent = text;
	const close = document.createElement('button');
	close.type = 'button';
	close.textContent = '✕';
	close.setAttribute('aria-label', words.close);
	const remove = () => box.remove();
	close.addEventListener('click', remove);
	box.append(sentence, close);
	const place = document.getElementById('notices');
	place?.append(box);
	while (place && place.children.length > MOST) place.firstElementChild?.remove();
	const leave = () => {
		// Not under a pointer, or from under the keyboard.
		if (box.matches(':hover, :focus-within')) setTimeout(leave, READING_TIME);
		else remove();
	};
	if (kind === 'note') onceLoaded(() => setTimeout(leave, Math.max(READING_TIME, LETTER_TIME * text.length)));
	return remove;
}

/** Calls back when nothing loads: who waits for a model does not read yet. */
function onceLoaded(call: () => void): void {
	const page = document.documentElement;
	if (page.dataset.state !== 'loading') {
		call();
		return;
	}
	const watch = new MutationObserver(() => {
		if (page.dataset.state === 'loading') return;
		watch.disconnect();
		call();
	});
	watch.observe(page, { attributeFilter: ['data-state'] });
}

/** Removes the notice about a subject. */
export function withdraw(about: string): void {
	if (about === '') return;
	for (const box of document.querySelectorAll<HTMLElement>('.notice')) if (box.dataset.about === about) box.remove();
}
