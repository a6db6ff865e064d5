/** Links to all steps: a rail of numbers with names, or a strip in narrow windows. */

/** Fills the rail, and marks the step being read. Sections of class `end` have no number. */
export function fillContents(nav: HTMLElement, label: string): void {
	nav.setAttribute('aria-label', label);
	const links = new Map<Element, HTMLAnchorElement>();
	let number = 0;
	for (const section of document.querySelectorAll('main section[id]')) {
		const link = document.createElement('a');
		link.href = `#${section.id}`;
		if (!section.classList.contains('end')) link.dataset.number = String(++number);
		const name = document.createElement('span');
		name.textContent = section.querySelector('h2')?.textContent ?? section.id;
		link.append(name);
		links.set(section, link);
		nav.append(link);
	}
	const seen = new IntersectionObserver(
		(changes) => {
			for (const { target, isIntersecting } of changes) {
				const link = links.get(target);
				link?.setAttribute('aria-current', String(isIntersecting));
				if (link && isIntersecting) reveal(nav, link);
			}
		},
		{ rootMargin: '-40% 0% -60% 0%' },
	);
	for (const section of links.keys()) seen.observe(section);
}

/** Scrolls the strip, never the page, until a link is in its middle. */
function reveal(nav: HTMLElement, { offsetLeft, offsetTop, offsetWidth, offsetHeight }: HTMLElement): void {
	nav.scrollTo({
		left: offsetLeft + offsetWidth / 2 - nav.clientWidth / 2,
		top: offsetTop + offsetHeight / 2 - nav.clientHeight / 2,
	});
}
