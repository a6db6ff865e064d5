/** Fallback without WebGL2: words and a picture. */

import { isWhole } from '../../page/webgl.ts';
import { words } from '../words/index.ts';

export function hasWebGL2(): boolean {
	return isWhole(document.createElement('canvas').getContext('webgl2'));
}

export function showFallback(): void {
	const box = document.createElement('div');
	box.id = 'fallback';
	const picture = document.createElement('img');
	picture.alt = words.still;
	picture.addEventListener('error', () => picture.remove());
	picture.src = 'still.jpg';
	const text = document.createElement('div');
	const heading = document.createElement('h1');
	heading.textContent = words.fallbackTitle;
	const advice = document.createElement('p');
	advice.textContent = words.fallback;
	text.append(heading, advice);
	box.append(picture, text);
	document.querySelector('main')?.replaceChildren(box);
}
