/** Figures of the lesson in the order in which they are built: the focused one, then those nearest to the window's middle. */

import { MARGIN } from '../../scene/Painter.ts';
import { standIn } from './standIn.ts';

/** Names of figures, and of the buttons that stand in for them. */
export interface FigureWords {
	figure: (step: string, number: number, of: number) => string;
	draw: (figure: string) => string;
}

/** Figure nearest to the middle of the window. */
function nearest(figures: Iterable<HTMLElement>): HTMLElement | undefined {
	const away = (figure: HTMLElement) => {
		const { top, bottom } = figure.getBoundingClientRect();
		return Math.abs((top + bottom - innerHeight) / 2);
	};
	return [...figures].sort((a, b) => away(a) - away(b))[0];
}

/** Name of a figure: its step's heading, with its number where the step has several. */
function nameOf(figure: HTMLElement, words: FigureWords): string {
	const step = figure.closest('section') ?? figure.parentElement;
	const all = [...(step?.querySelectorAll(':scope > figure') ?? [])];
	const heading = step?.querySelector('h1, h2')?.textContent ?? '';
	return words.figure(heading, all.indexOf(figure) + 1, all.length);
}

/**
 * Names all figures, and builds one after the other as the window or the focus comes near; at least one.
 *
 * @param build resolves when the figure's controls are there, or the reason why there are none
 * @returns function that builds all others
 */
export function buildFigures(
	figures: readonly HTMLElement[],
	build: (figure: HTMLElement) => Promise<void>,
	words: FigureWords,
): () => void {
	const waiting = new Set<HTMLElement>();
	const replaced = new Map<HTMLElement, () => void>();
	let building = false;
	const next = async () => {
		const focused = [...waiting].find((figure) => figure.contains(document.activeElement));
		const figure = focused ?? nearest(waiting);
		if (!figure || building) return;
		waiting.delete(figure);
		building = true;
		await build(figure);
		replaced.get(figure)?.();
		building = false;
		void next();
	};
	const want = (...wanted: HTMLElement[]) => {
		// A figure may be wanted twice.
		for (const figure of wanted) if (!figure.dataset.state) waiting.add(figure);
		void next();
	};
	for (const figure of figures) {
		const name = nameOf(figure, words);
		figure.setAttribute('aria-label', name);
		replaced.set(
			figure,
			standIn(figure, words.draw(name), () => want(figure)),
		);
	}
	const near = new IntersectionObserver(
		(changes) => {
			const found = changes.filter(({ isIntersecting }) => isIntersecting).map(({ target }) => target as HTMLElement);
			for (const figure of found) near.unobserve(figure);
			want(...found);
		},
		{ rootMargin: MARGIN },
	);
	for (const figure of figures) near.observe(figure);
	// In a small window none may be near.
	const first = nearest(figures);
	if (first) want(first);
	return () => want(...figures);
}
