/** The demo page: composes picture, exhibit and controls. */

import { element, setState } from '../page/element.ts';
import { fillHeader } from '../page/header.ts';
import { fillIn } from '../page/language.ts';
import { parseAddress } from './address.ts';
import { Controls } from './controls.ts';
import { listenToDrops } from './drop.ts';
import { Exhibit } from './exhibit.ts';
import { hasWebGL2, showFallback } from './fallback.ts';
import { listenToHands } from './hands.ts';
import { notice } from './notice.ts';
import { Overlay } from './overlay.ts';
import { Picture } from './picture.ts';
import { explain } from './problems.ts';
import { Progress } from './progress.ts';
import type { Act } from './tools.ts';
import { en } from './words/drop.en.ts';
import { zh } from './words/drop.zh.ts';
import { language, words } from './words/index.ts';

function start(): void {
	const { view, problems } = parseAddress(location.search);
	if (problems.length) notice(words.inAddress(problems.map(explain).join('\n')));
	document.body.classList.toggle('bare', !view.ui);

	const hint = element('hint');
	const canvas = element<HTMLCanvasElement>('picture');
	const calm = view.still || matchMedia('(prefers-reduced-motion: reduce)').matches;
	const picture = new Picture(canvas, {
		...{ still: view.still, calm },
		turned: () => {
			view.camera = picture.camera.orbit;
			if (controls.tools.act === 'camera') hint.hidden = true;
			controls.write();
		},
	});
	if (view.ui) picture.overlay = new Overlay(element('overlay'), picture.stage, picture.timer, words, language);
	const exhibit = new Exhibit(picture, view, new Progress(element<HTMLProgressElement>('progress')));
	const controls = new Controls(element('panel'), picture, exhibit, view);
	const tell = (act: Act) => {
		const more = matchMedia('(pointer: coarse)').matches ? words.hintTouch : words.hintMouse;
		hint.textContent = `${words.hints[act]} · ${more}`;
		hint.hidden = false;
	};
	tell('light');
	listenToHands(picture, controls.tools, exhibit.play, {
		lightTaken: () => {
			view.light = picture.light.wanted;
			controls.write();
		},
		chosen: (act) => {
			tell(act);
			void exhibit.style();
		},
		used: () => {
			hint.hidden = true;
		},
	});
	const dropped = { en, zh }[language];
	const opener = listenToDrops(window, language, {
		opening: (task) => void exhibit.change(() => task),
		opened: async (own) => {
			await exhibit.receive(own);
			controls.write();
		},
		failed: (name, reason) => notice(words.notShown(name, reason), 'error', 'model'),
	});
	controls.panel.button(dropped.open, opener.files, dropped.openTip);
	if (opener.folder) controls.panel.button(dropped.openFolder, opener.folder, dropped.openFolderTip);
	canvas.addEventListener('webglcontextlost', () => {
		exhibit.living.forget();
		exhibit.looks.forget();
		picture.stage.forget();
		if (picture.stage.model) setState('loading');
	});
	canvas.addEventListener('webglcontextrestored', () => {
		picture.timer.restore();
		void exhibit.style();
		void exhibit.settle();
	});
	picture.fit();
	void exhibit.open();
}

fillIn(words, language);
fillHeader(document.querySelector('nav.site') as HTMLElement, 'demo', language);
if (hasWebGL2()) {
	start();
} else {
	showFallback();
	setState('failed');
}
