/** Words for the visitor, above the picture. */

const readingTime = 9000; // milliseconds

/**
 * @param kind `error` stays until it is closed, `note` goes by itself
 * @returns what takes it away
 */
export function notice(text: string, kind: 'note' | 'error' = 'note'): () => void {
	const box = document.createElement('div');
	box.className = `notice ${kind}`;
	const words = document.createElement('p');
	words.textContent = text;
	const close = document.createElement('button');
	close.type = 'button';
	close.textContent = '✕';
	close.setAttribute('aria-label', 'Close this message');
	const remove = () => box.remove();
	close.addEventListener('click', remove);
	box.append(words, close);
	document.getElementById('notices')?.append(box);
	if (kind === 'note') setTimeout(remove, readingTime);
	return remove;
}
