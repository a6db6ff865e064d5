/** Input on a picture within a page: drags and arrow keys; vertical strokes of a finger scroll the page. */

import { Vector2 } from 'three';

const ARROWS: Record<string, [right: number, up: number]> = {
	ArrowLeft: [-1, 0],
	ArrowRight: [1, 0],
	ArrowUp: [0, 1],
	ArrowDown: [0, -1],
};

/** Pixels that a finger moves in a tap. */
const SLACK = 10;

/** Calls back for arrow keys while `target` is focused. */
export function arrows(
	target: GlobalEventHandlers,
	step: (right: number, up: number, event: KeyboardEvent) => void,
): void {
	target.addEventListener('keydown', (event: KeyboardEvent) => {
		const arrow = ARROWS[event.key];
		if (!arrow || event.ctrlKey || event.metaKey || event.altKey) return;
		event.preventDefault();
		step(...arrow, event);
	});
}

/**
 * Calls `move` with the place on the canvas, in normalised device coordinates (-1..1, y up), of a dragging mouse, pen or
 * finger, and `end` on release.
 * The style sheet leaves vertical strokes of a finger to the page: `touch-action: pan-y`.
 *
 * @param accepts whether a pointer that comes down begins a drag; the left button by default
 */
export function listenToDrags(
	canvas: HTMLCanvasElement,
	move: (pointer: Vector2) => void,
	end: () => void = () => {},
	accepts: (event: PointerEvent) => boolean = ({ button }) => button === 0,
): void {
	const pointer = new Vector2();
	let dragging: number | undefined;
	let touched: { id: number; x: number; y: number } | undefined;
	const follow = ({ clientX, clientY }: PointerEvent) => {
		const { left, top, width, height } = canvas.getBoundingClientRect();
		move(pointer.set(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2));
	};
	canvas.addEventListener('pointerdown', (event) => {
		if (!accepts(event)) return;
		if (event.pointerType === 'touch') {
			touched = { id: event.pointerId, x: event.clientX, y: event.clientY };
			return;
		}
		canvas.setPointerCapture(event.pointerId);
		dragging = event.pointerId;
		follow(event);
	});
	canvas.addEventListener('pointermove', (event) => {
		const { pointerId: id, clientX: x, clientY: y } = event;
		if (id === touched?.id && Math.abs(x - touched.x) > Math.abs(y - touched.y)) dragging = id;
		if (id === dragging) follow(event);
	});
	canvas.addEventListener('pointerup', (event) => {
		// A tap is a drag of length 0.
		if (event.pointerId !== touched?.id || dragging !== undefined) return;
		if (Math.hypot(event.clientX - touched.x, event.clientY - touched.y) > SLACK) return;
		follow(event);
		end();
	});
	for (const name of ['pointerup', 'pointercancel', 'lostpointercapture'] as const)
		canvas.addEventListener(name, ({ pointerId }) => {
			if (pointerId === touched?.id) touched = undefined;
			if (pointerId !== dragging) return;
			dragging = undefined;
			end();
		});
}
