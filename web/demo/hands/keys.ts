/** Keyboard on the picture: arrow keys move the light (or the camera, the brush, the body), + and - zoom. */

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

export function listenToKeys({ arrow, zoom }: KeyHandlers): void {
	addEventListener('keydown', (event) => {
		// The panel's fields, the tools and the line of the split have their own use for these keys.
		if (event.ctrlKey || event.altKey || event.metaKey) return;
		if (event.target instanceof Element && event.target.closest('#panel, [role=slider], [role=radiogroup]')) return;
		const way = ARROWS[event.key];
		const size = event.shiftKey ? 3 * STEP : STEP;
		if (way) arrow(way[0] * size, way[1] * size);
		else if (event.key === '+' || event.key === '=') zoom(1 / 1.08);
		else if (event.key === '-') zoom(1.08);
		else return;
		event.preventDefault();
	});
}
