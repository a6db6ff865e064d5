/** Instead of a blank page: words and a picture where there is no WebGL2. */

export function hasWebGL2(): boolean {
	return document.createElement('canvas').getContext('webgl2') !== null;
}

export function showFallback(): void {
	const box = document.createElement('main');
	box.id = 'fallback';
	const picture = document.createElement('img');
	picture.alt = 'A furry bunny, lit from the side';
	picture.addEventListener('error', () => picture.remove());
	picture.src = 'still.jpg';
	const words = document.createElement('div');
	const heading = document.createElement('h1');
	heading.textContent = 'This page needs WebGL2';
	const advice = document.createElement('p');
	advice.textContent =
		'furbake draws fur that you relight by dragging. This browser does not offer WebGL2, or it is switched off: ' +
		'please use a current Chrome, Edge, Firefox or Safari, or switch hardware acceleration on.';
	words.append(heading, advice);
	box.append(picture, words);
	document.body.classList.add('bare');
	document.getElementById('picture')?.remove();
	document.body.append(box);
}
