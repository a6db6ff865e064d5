/** Room of the model: what the controls leave of the picture. The model stands in its middle, words about it keep to it. */

import { freeRoom, type Room } from '../../page/room.ts';
import type { Picture } from '../stage/picture.ts';

/** Keeps the model in the room that the covers leave, while they open, close and change places. */
export function keepRoom(picture: Picture, covers: readonly Element[]): void {
	const { canvas } = picture;
	const root = document.documentElement;
	let before = '';
	const measure = () => {
		const { left, top, width, height } = canvas.getBoundingClientRect();
		const rooms = covers.map((cover): Room => {
			const box = cover.getBoundingClientRect();
			return { left: box.left - left, top: box.top - top, width: box.width, height: box.height };
		});
		const room = freeRoom(width, height, rooms);
		const now = [width, height, ...Object.values(room)].join();
		if (now === before) return;
		before = now;
		// Sizes of the picture, which is as large as the window.
		const insets = {
			left: room.left,
			top: room.top,
			right: width - room.left - room.width,
			bottom: height - room.top - room.height,
		};
		for (const [side, inset] of Object.entries(insets)) root.style.setProperty(`--room-${side}`, `${inset}px`);
		picture.enter(room);
	};
	const observer = new ResizeObserver(measure);
	for (const element of [canvas, ...covers]) observer.observe(element);
	measure();
}
