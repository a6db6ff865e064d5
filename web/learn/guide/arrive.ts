/** Arrival at a step: it stays where it belongs while figures above it are built and grow, until the visitor scrolls. */

/** Input after which the page's place is the visitor's. */
const INPUT = ['wheel', 'touchmove', 'pointerdown', 'keydown'] as const;

/** Brings the step that the address names into sight, and each one whose link is followed. */
export function arriveAtSteps(): void {
	const { documentElement: root } = document;
	let step: HTMLElement | undefined;
	/** The page's place at the last scroll to it, and its distance from the window's top there. */
	let [place, top] = [0, 0];
	const put = () => {
		step?.scrollIntoView({ behavior: 'instant' });
		[place, top] = [scrollY, topOf(step)];
	};
	const leave = () => {
		step = undefined;
		root.style.overflowAnchor = '';
	};
	const arrive = (hash: string) => {
		const named = document.getElementById(decodeURIComponent(hash.slice(1)));
		if (!named) return;
		step = named;
		// Otherwise the browser's own scrolls could not be told from the visitor's.
		root.style.overflowAnchor = 'none';
		put();
	};
	new ResizeObserver(put).observe(document.body);
	addEventListener('scroll', () => {
		// While the page loads the browser itself scrolls to the step. Afterwards: a scroll bar, a search, a script.
		const away = Math.abs(scrollY - place) > 1 && Math.abs(topOf(step) - top) > 1;
		if (away && document.readyState === 'complete') leave();
	});
	for (const name of INPUT) addEventListener(name, leave, { capture: true, passive: true });
	addEventListener('click', ({ target, ctrlKey, metaKey, shiftKey }) => {
		const link = (target as Element).closest<HTMLAnchorElement>('a[href^="#"]');
		if (link && !ctrlKey && !metaKey && !shiftKey) arrive(link.hash);
	});
	arrive(location.hash);
}

const topOf = (step: HTMLElement | undefined): number => step?.getBoundingClientRect().top ?? 0;
