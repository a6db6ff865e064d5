/** The bench's page: measures when asked to, shows what it finds, and hands it on. */

import { type Listener, measure } from '../measure/measure.ts';
import { DEFAULTS, type Part, QUICK } from '../measure/plan.ts';
import type { BenchFigures } from '../measure/results.ts';
import { parseOptions } from './options.ts';
import { gallery, sectionElement } from './page.ts';
import { sections } from './report.ts';

const DOING: Record<Part, string> = {
	results: 'methods',
	layers: 'methods, triangles counted over all layers',
	costs: 'what features cost',
	curves: 'frames against shells and pixels',
};

/** Milliseconds between two words on the progress: the page must not draw much while it measures. */
const PAUSE = 1000;

function element<T extends HTMLElement>(id: string): T {
	const found = document.getElementById(id);
	if (!found) throw new Error(`#${id} is not in the page`);
	return found as T;
}

const { options, quick: asked, run, post, problems } = parseOptions(location.search);
const [button, quick] = [element<HTMLButtonElement>('run'), element<HTMLInputElement>('quick')];
const [bar, doing, problem] = [element<HTMLProgressElement>('bar'), element('doing'), element('problem')];
const pictures = document.createElement('div');
const texts = document.createElement('div');
element('report').append(pictures, texts);
let running: AbortController | undefined;
let latest: BenchFigures | undefined;

function setState(state: 'ready' | 'running' | 'done' | 'failed'): void {
	document.documentElement.dataset.state = state;
}

function complain(words: string): void {
	problem.textContent = words;
	problem.hidden = words === '';
}

/** Tells the command that opened this page. Where it has gone there is nobody to tell. */
async function tell(message: object): Promise<void> {
	if (post) await fetch(post, { method: 'POST', body: JSON.stringify(message) }).catch(() => {});
}

function duration(seconds: number): string {
	return seconds < 90 ? `${Math.ceil(seconds)} s` : `${Math.round(seconds / 60)} min`;
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
			// An estimate from the first few frames, which compile, would frighten.
			const left = share > 0.04 ? `, about ${duration(((now - started) / 1000) * (1 / share - 1))} left` : '';
			doing.textContent = `${Math.floor(100 * share)} %${left}: ${part ? DOING[part] : 'loading the models'}`;
			void tell({ doing: doing.textContent });
		},
		portraits: (portraits) => pictures.replaceChildren(gallery(portraits)),
		figures: show,
	};
}

function show(figures: BenchFigures): void {
	latest = figures;
	const machine = document.createElement('p');
	machine.id = 'machine';
	machine.textContent = `${figures.device}, ${figures.cores} cores, ${duration(figures.seconds)} in all. ${figures.browser}`;
	texts.replaceChildren(machine, ...sections(figures).map(sectionElement));
	element('keep').hidden = false;
}

async function start(): Promise<void> {
	running = new AbortController();
	button.textContent = 'Stop';
	quick.disabled = true;
	element('progress').hidden = false;
	bar.value = 0;
	complain('');
	setState('running');
	try {
		const wanted = quick.checked === asked ? options : quick.checked ? QUICK : DEFAULTS;
		const figures = await measure(wanted, running.signal, listener());
		setState('done');
		await tell({ figures, sections: sections(figures).map(({ title, tables }) => ({ title, tables })) });
	} catch (error) {
		const stopped = running.signal.aborted;
		const words = (error as Error).message;
		if (!stopped) {
			complain(`It could not be measured: ${words}`);
			await tell({ error: words });
		}
		setState(stopped ? 'ready' : 'failed');
	}
	running = undefined;
	button.textContent = latest ? 'Measure again' : 'Measure';
	quick.disabled = false;
	element('progress').hidden = true;
}

element('controls').addEventListener('submit', (event) => {
	event.preventDefault();
	if (running) running.abort();
	else void start();
});
element('download').addEventListener('click', () => {
	const link = document.createElement('a');
	link.href = URL.createObjectURL(new Blob([json()], { type: 'application/json' }));
	link.download = 'furbake-bench.json';
	link.click();
	URL.revokeObjectURL(link.href);
});
const copy = element('copy');
copy.addEventListener('click', async () => {
	const copied = await navigator.clipboard.writeText(json()).then(
		() => true,
		() => false,
	);
	copy.textContent = copied ? 'Copied' : 'The browser does not allow it';
	setTimeout(() => {
		copy.textContent = 'Copy';
	}, 2000);
});

function json(): string {
	return `${JSON.stringify(latest, null, '\t')}\n`;
}

quick.checked = asked;
if (problems.length) complain(`In the address: ${problems.join('; ')}.`);
setState('ready');
if (run) void start();
