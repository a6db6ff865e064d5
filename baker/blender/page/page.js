/** Shows the baked folder that the address numbers, with its clips to choose from. */
import './fur-view.js';

const model = /^\d+$/.exec(new URLSearchParams(location.search).get('model') ?? '')?.[0] ?? '0';
const view = document.createElement('fur-view');
const label = /** @type {HTMLLabelElement} */ (document.querySelector('label'));
const menu = /** @type {HTMLSelectElement} */ (document.querySelector('select'));
view.setAttribute('src', `${model}/model.gltf`);
view.setAttribute('alt', 'The baked model under a lamp');
view.toggleAttribute('controls', true);
view.addEventListener('ready', () => {
	document.documentElement.dataset.state = 'ready';
	if (view.clips.length === 0 || menu.options.length > 0) return;
	for (const clip of view.clips) menu.add(new Option(clip));
	view.clip = menu.value;
	label.hidden = false;
});
view.addEventListener('error', () => {
	document.documentElement.dataset.state = 'failed';
});
menu.addEventListener('change', () => {
	view.clip = menu.value;
});
document.querySelector('main')?.append(view);
