/** The demo page: composes state, picture, exhibit and controls. */

import { element, setState } from '../page/element.ts';
import { fillHeader } from '../page/header.ts';
import { fillIn } from '../page/language.ts';
import { Gestures } from './hands/gestures.ts';
import { listenToHands } from './hands/hands.ts';
import { type DragAction, Tools } from './hands/tools.ts';
import { Exhibit } from './model/exhibit.ts';
import { listenToDrops } from './open/drop.ts';
import { Controls } from './panel/controls.ts';
import { keepRoom } from './panel/room.ts';
import { explain } from './say/explain.ts';
import { hasWebGL2, showFallback } from './say/fallback.ts';
import { notice } from './say/notice.ts';
import { Progress } from './say/progress.ts';
import { Overlay } from './stage/overlay.ts';
import { Picture } from './stage/picture.ts';
import { followInAddressBar, parseAddress } from './state/address.ts';
import { Store } from './state/store.ts';
import type { Triple } from './state/view.ts';
import { en } from './words/drop.en.ts';
import { zh } from './words/drop.zh.ts';
import { language, words } from './words/index.ts';

function start(): void {
	const { view, problems } = parseAddress(location.search);
	if (problems.length) notice(words.inAddress(problems.map(explain).join('\n')));
	document.body.classList.toggle('bare', !view.ui);
	const store = new Store(view);
	const tools = new Tools();
	const hint = element('hint');
	const canvas = element<HTMLCanvasElement>('picture');
	const hinted = () => showHint(hint, tools.act, canvas.matches(':focus-visible'));
	hinted();
	canvas.addEventListener('focus', hinted);

	const { still, ui } = view;
	const calm = still || matchMedia('(prefers-reduced-motion: reduce)').matches;
	const turned = (camera: Triple) => {
		store.change({ camera });
		if (tools.act === 'camera') hint.hidden = true;
	};
	const picture = new Picture(canvas, { still, calm, turned });
	if (ui) picture.overlay = addOverlay(picture, store);
	const exhibit = new Exhibit(picture, store, new Progress(element<HTMLProgressElement>('progress')));
	const controls = new Controls(element('panel'), tools, picture, exhibit, store);
	const gestures = new Gestures(picture, exhibit.looks, exhibit.dynamics);
	picture.animate = (elapsed) => Math.min(gestures.step(elapsed), exhibit.step(elapsed));
	picture.space = (spacing) => exhibit.looks.space(spacing);
	listenToHands(picture, tools, gestures, {
		lightTaken: () => store.change({ light: picture.light.wanted }),
		chosen: () => {
			hinted();
			void exhibit.style();
		},
		used: () => {
			hint.hidden = true;
		},
	});
	addOpener(exhibit, controls);
	if (ui) keepRoom(picture, [element('top'), controls.panel.element, element('dock')]);
	followContext(picture, exhibit);
	picture.fit();
	holdOnRequest(picture, exhibit, store);
	void exhibit.open().then(async () => {
		// The address stays as it was asked for until something changes after that.
		followInAddressBar(store);
		const spoken = await import('./say/spoken.ts').catch(() => undefined);
		spoken?.speak(canvas, language, {
			model: () => exhibit.title,
			lamp: () => picture.light.wanted,
			camera: () => picture.camera.orbit,
			act: () => tools.act,
		});
	});
}

/** Ends all that moves by itself when the system asks for less motion meanwhile; the lamp's drift with a clip that is held. */
function holdOnRequest(picture: Picture, exhibit: Exhibit, store: Store): void {
	const hold = () => picture.light.want(() => {});
	store.subscribe(({ time }, changed) => {
		if (changed.includes('time') && time !== undefined) hold();
	});
	matchMedia('(prefers-reduced-motion: reduce)').addEventListener('change', ({ matches }) => {
		if (!matches) return;
		hold();
		store.change({ time: picture.stage.model?.clips?.time, turn: undefined, wind: undefined });
		void exhibit.style();
	});
}

/** Adds the figures; whether all of them are shown is in the view. */
function addOverlay(picture: Picture, store: Store): Overlay {
	const switched = (details: boolean) => store.change({ details: details || undefined });
	const overlay = new Overlay(element('overlay'), picture, words, language, switched);
	const show = () => {
		overlay.details = store.get().details ?? false;
	};
	store.subscribe(show);
	show();
	return overlay;
}

/** Says what a drag does. @param keys whether the picture was reached by the keyboard */
function showHint(hint: HTMLElement, act: DragAction, keys: boolean): void {
	const { hintKeys, hintTouch, hintMouse, hintZoom } = words;
	const mouse = act === 'camera' ? hintZoom : hintMouse;
	const more = keys ? hintKeys : matchMedia('(pointer: coarse)').matches ? hintTouch : mouse;
	// A line ends with a dot, none begins with one.
	const line = document.createElement('span');
	line.textContent = `${words.hints[act]} · ${more}`.replaceAll(' ·', '\u00a0·');
	hint.replaceChildren(line);
	hint.hidden = false;
}

/** Opens models that are dropped on the page or chosen by a button. */
function addOpener(exhibit: Exhibit, { panel }: Controls): void {
	const dropped = { en, zh }[language];
	const opener = listenToDrops(window, language, {
		opening: (task) => void exhibit.change(() => task),
		opened: (own) => exhibit.receive(own),
		failed: (name, reason) => notice(words.notShown(name, reason), 'error', 'model'),
	});
	panel.button(dropped.open, opener.files, dropped.openTip);
	if (opener.folder) panel.button(dropped.openFolder, opener.folder, dropped.openFolderTip);
}

/** Frees what a lost context takes along, and draws anew in the next one. */
function followContext(picture: Picture, exhibit: Exhibit): void {
	picture.canvas.addEventListener('webglcontextlost', () => {
		exhibit.dynamics.loseContext();
		exhibit.looks.loseContext();
		picture.stage.loseContext();
		if (picture.stage.model) setState('loading');
	});
	picture.canvas.addEventListener('webglcontextrestored', () => {
		picture.gpu.restore();
		void exhibit.style();
		void exhibit.settle();
	});
}

fillIn(words, language);
fillHeader(document.querySelector('nav.site') as HTMLElement, 'demo', language);
if (hasWebGL2()) {
	start();
} else {
	showFallback();
	setState('failed');
}
