/** Lesson: text of one language with its figures, each built when the window or the focus comes near. */

import 'katex/dist/katex.min.css';
import { element, setState } from '../page/element.ts';
import { fillHeader } from '../page/header.ts';
import { fillIn, type Language, languageOf } from '../page/language.ts';
import { Painter } from '../scene/Painter.ts';
import { Calm } from './calm.ts';
import { action } from './controls.ts';
import { arriveAtSteps } from './guide/arrive.ts';
import { fillContents } from './guide/contents.ts';
import { buildFigures } from './guide/figures.ts';
import { holdButton } from './guide/hold.ts';
import type { Lesson, Mount } from './lesson.ts';
import { SharedLight } from './light.ts';
import { WORDS } from './words/index.ts';

const texts: Record<Language, () => Promise<{ default: string }>> = {
	en: () => import('./text/en.md'),
	zh: () => import('./text/zh.md'),
};

const steps: Record<string, () => Promise<{ mount: Mount }>> = {
	hello: () => import('./guide/hello.ts'),
	shells: () => import('./steps/shells.ts'),
	slices: () => import('./steps/slices.ts'),
	hair: () => import('./byhand/step.ts'),
	dome: () => import('./steps/dome.ts'),
	texel: () => import('./steps/texel.ts'),
	mean: () => import('./mean/step.ts'),
	bits: () => import('./steps/bits.ts'),
	numbers: () => import('./steps/numbers.ts'),
	body: () => import('./steps/body.ts'),
	nap: () => import('./steps/nap.ts'),
	rivals: () => import('./steps/rivals.ts'),
	tuft: () => import('./steps/tuft.ts'),
	turning: () => import('./steps/turning.ts'),
	short: () => import('./steps/short.ts'),
	spring: () => import('./steps/spring.ts'),
	wind: () => import('./steps/wind.ts'),
	pose: () => import('./pose/step.ts'),
	wet: () => import('./steps/wet.ts'),
};

function newLesson(language: Language): Lesson {
	const still = new URLSearchParams(location.search).get('still') === '1';
	const calm = new Calm(still, matchMedia('(prefers-reduced-motion: reduce)'));
	const painter = new Painter();
	const light = new SharedLight([-0.62, 0.62, 0.48], calm, () => painter.wake());
	painter.animate((elapsed) => light.step(elapsed));
	calm.listen(() => painter.wake());
	return { language, words: WORDS[language], calm, light, painter };
}

/** Builds one figure, or shows why it failed. */
async function build(figure: HTMLElement, lesson: Lesson): Promise<void> {
	const place = document.createElement('div');
	place.className = 'live';
	figure.prepend(place);
	figure.dataset.state = 'loading';
	try {
		const step = steps[figure.dataset.figure ?? ''];
		if (!step) throw new Error(`no step is called ${figure.dataset.figure}`);
		const { mount } = await step();
		await mount(place, lesson);
	} catch (error) {
		const { message } = error as Error;
		const { failed, needsWebGL2 } = lesson.words;
		place.className = 'words';
		place.textContent = message === needsWebGL2 ? message : failed(message);
		figure.dataset.state = 'failed';
	}
	void settled(figure, place, lesson);
}

/** Marks the figure as drawn, and the page with its first one. */
async function settled(figure: HTMLElement, place: HTMLElement, { painter }: Lesson): Promise<void> {
	if (figure.dataset.state !== 'failed') {
		await painter.drawn(place);
		figure.dataset.state = 'ready';
	}
	if (document.documentElement.dataset.state === 'loading') setState(figure.dataset.state as 'ready' | 'failed');
}

async function start(): Promise<void> {
	const language = languageOf(location.search, navigator.languages);
	fillIn(WORDS[language], language);
	fillHeader(document.querySelector('nav.site') as HTMLElement, 'learn', language);
	element('lesson').innerHTML = (await texts[language]()).default;
	fillContents(element('steps'), WORDS[language].steps);
	arriveAtSteps();

	const lesson = newLesson(language);
	const figures = [...document.querySelectorAll<HTMLElement>('figure[data-figure]')];
	const buildAll = buildFigures(figures, (figure) => build(figure, lesson), lesson.words);
	if (figures[0]) holdButton(figures[0], lesson.words.hold, lesson.calm);

	const print = action(document.getElementById('more') ?? document.body, lesson.words.print, async () => {
		if (print.ariaDisabled) return;
		// Keeps the focus, unlike `disabled`.
		print.ariaDisabled = 'true';
		buildAll();
		while (figures.some(({ dataset: { state } }) => !state || state === 'loading'))
			await new Promise(requestAnimationFrame);
		print.ariaDisabled = null;
		window.print();
	});
}

void start();
