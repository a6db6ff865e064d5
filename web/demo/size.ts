/** When the picture has another size: the window's, the layout's, or that of the screen's pixels. */

/** @param changed called when the canvas, or a pixel of the screen, has become larger or smaller */
export function watchSize(canvas: HTMLCanvasElement, changed: () => void): void {
	new ResizeObserver(changed).observe(canvas);
	// The query is about one ratio: it tells that this one has gone.
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
