/**
 * Keyboard of the picture: arrow keys move the light (or the camera, the brush, the body), + and - zoom.
 *
 * Arrow keys act while nothing else has the focus, too. Signs only act on the picture itself: speech input types them.
 */

const STEP = 4; // degrees; with Shift three times as far

export interface KeyHandlers {
	/** degrees to the right and up */
	arrow(right: number, up: number): void;
	/** factor of the distance */
	zoom(factor: number): void;
}

const ARROWS: Record<string, [number, number]> = {
	ArrowLeft: [-1, 0],
	ArrowRight: [1, 0],
	ArrowUp: [0, 1],
	ArrowDown: [0, -1],
};

/** @param cameraButton button that lets arrow keys turn the camera, and keeps the focus */
export function listenToKeys(picture: Element, cameraButton: Element, { arrow, zoom }: KeyHandlers): void {
	addEventListener('keydown', (event) => {
		if (event.ctrlKey || event.altKey || event.metaKey) return;
		const onPicture = event.target === picture;
		if (!onPicture && event.target !== document.body && event.target !== cameraButton) return;
		const way = ARROWS[event.key];
		const size = event.shiftKey ? 3 * STEP : STEP;
		if (way) arrow(way[0] * size, way[1] * size);
		else if (onPicture && (event.key === '+' || event.key === '=')) zoom(1 / 1.08);
		else if (onPicture && event.key === '-') zoom(1.08);
		else return;
		event.preventDefault();
	});
}
