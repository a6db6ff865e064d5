/** Page of the bench: measures on request, shows the figures and posts them. */

import { type Listener, measure } from '../measure/bench/measure.ts';
import { DEFAULTS, QUICK } from '../measure/bench/plan.ts';
import type { BenchFigures } from '../measure/bench/results.ts';
import { element, setState } from '../page/element.ts';
import { fillHeader } from '../page/header.ts';
import { fillIn, languageOf } from '../page/language.ts';
import { copy, download } from '../page/share.ts';
import { type Problem, parseOptions } from './options.ts';
import { gallery, sectionElement } from './page.ts';
import { sections } from './report.ts';
import { WORDS } from './words/index.ts';

/** Milliseconds between two updates of the progress: drawing the page disturbs the measurement. */
const PAUSE = 1000;

const language = languageOf(location.search, navigator.languages);
const words = WORDS[language];
fillIn(words, language);
fillHeader(element('site'), 'bench', language);

const { options, quick: asked, run, post, problems } = parseOptions(location.search);
const [button, quick] = [element<HTMLButtonElement>('run'), element<HTMLInputElement>('quick')];
const [bar, doing, problem] = [element<HTMLProgressElement>('bar'), element('doing'), element('problem')];
/** Beginning and end, spoken; the progress between them, once a second, would be too much. */
const outcome = element('outcome');
const pictures = document.createElement('div');
const texts = document.createElement('div');
element('report').append(pictures, texts);
let running: AbortController | undefined;
let latest: BenchFigures | undefined;

function complain(text: string): void {
	problem.textContent = text;
	problem.hidden = text === '';
}

/** Posts a message to the command that opened this page; ignored if it has ended. */
async function tell(message: object): Promise<void> {
	if (post) await fetch(post, { method: 'POST', body: JSON.stringify(message) }).catch(() => {});
}

function listener(): Listener {
	const started = performance.now();
	let said = 0;
	return {
		progress(share, part) {
			const now = performance.now();
			if (now < said + PAUSE) return;
			said = now;
			bar.value = share;
			// No estimate from the first few frames, which compile.
			const left = share > 0.04 ? ((now - started) / 1000) * (1 / share - 1) : undefined;
			doing.textContent = words.doing(Math.floor(100 * share), left, part ?? 'loading');
			void tell({ doing: doing.textContent });
		},
		methodPictures: (methodPictures) => pictures.replaceChildren(gallery(methodPictures, words)),
		figures: show,
	};
}

function show(figures: BenchFigures): void {
	latest = figures;
	const machine = document.createElement('p');
	machine.id = 'machine';
	machine.textContent = words.machine(figures.device, figures.cores, figures.seconds, figures.browser);
	texts.replaceChildren(machine, ...sections(figures, words).map(sectionElement));
	element('keep').hidden = false;
}

async function start(): Promise<void> {
	running = new AbortController();
	button.textContent = words.stop;
	outcome.textContent = words.measuring;
	quick.disabled = true;
	element('progress').hidden = false;
	bar.value = 0;
	setState('running');
	try {
		const wanted = quick.checked === asked ? options : quick.checked ? QUICK : DEFAULTS;
		const figures = await measure(wanted, running.signal, listener());
		setState('done');
		outcome.textContent = words.done;
		await tell({ figures, sections: sections(figures, words).map(({ title, tables }) => ({ title, tables })) });
	} catch (error) {
		const stopped = running.signal.aborted;
		const { message } = error as Error;
		outcome.textContent = stopped ? words.stopped : '';
		if (!stopped) {
			complain(words.failed(message));
			await tell({ error: message });
		}
		setState(stopped ? 'ready' : 'failed');
	}
	running = undefined;
	button.textContent = latest ? words.again : words.measure;
	quick.disabled = false;
	element('progress').hidden = true;
}

element('controls').addEventListener('submit', (event) => {
	event.preventDefault();
	if (running) {
		running.abort();
		return;
	}
	complain('');
	void start();
});
element('download').addEventListener('click', () => {
	download(new Blob([json()], { type: 'application/json' }), 'furbake-bench.json');
});
const copying = element('copy');
copying.addEventListener('click', async () => {
	copying.textContent = (await copy(json())) ? words.copied : words.notCopied;
	setTimeout(() => {
		copying.textContent = words.copy;
	}, 2000);
});

function json(): string {
	return `${JSON.stringify(latest, null, '\t')}\n`;
}

function describe({ given, expected }: Problem): string {
	const { some } = words.expected;
	return words.problem(given, typeof expected === 'string' ? words.expected[expected] : some(expected));
}

quick.checked = asked;
if (problems.length) complain(words.problems(problems.map(describe)));
setState('ready');
if (run) void start();
