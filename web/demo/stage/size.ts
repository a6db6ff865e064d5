/** Changes of the picture's size, of the window, the layout, or the screen's pixels, and whether it is in sight. */

/** @param changed called after a change of the canvas's size or of the pixel ratio */
export function watchSize(canvas: HTMLCanvasElement, changed: () => void): void {
	new ResizeObserver(changed).observe(canvas);
	// A query knows one ratio only: its change means that another is due.
	const watchPixels = () =>
		matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener(
			'change',
			() => {
				watchPixels();
				changed();
			},
			{ once: true },
		);
	watchPixels();
}

/** @param changed called with whether any of the canvas can be seen, where that changes */
export function watchSight(canvas: HTMLCanvasElement, changed: (inSight: boolean) => void): void {
	new IntersectionObserver((entries) => changed(entries.at(-1)?.isIntersecting ?? true)).observe(canvas);
}
