/** Room for a picture's subject: the part of the picture that nothing covers. */

/** CSS pixels from the picture's left upper corner. */
export interface Room {
	left: number;
	top: number;
	width: number;
	height: number;
}

/** Shorter side of the smallest room, in shorter sides of the picture: less than that is no room. */
const SMALLEST = 0.3;

/**
 * Finds the rectangle with the largest circle that meets none of the covers, where each pixel of the circle's width weighs
 * as much as one between its middle and the picture's; of several the one of the largest area.
 *
 * @param width of the picture in CSS pixels
 * @param covers rectangles that lie over it; they may reach beyond it, or be empty
 * @returns the whole picture where the covers leave next to nothing
 */
export function freeRoom(width: number, height: number, covers: readonly Room[]): Room {
	const sides = covers.map(({ left, top, width: w, height: h }) => [left, top, left + w, top + h] as const);
	const over = sides.filter(([left, top, right, bottom]) => {
		const [x, y] = [Math.min(right, width) - Math.max(left, 0), Math.min(bottom, height) - Math.max(top, 0)];
		return x > 0 && y > 0;
	});
	const whole: Room = { left: 0, top: 0, width, height };
	if (over.length === 0) return whole;
	let best = whole;
	let most = Number.NEGATIVE_INFINITY;
	const [lefts, rights] = [
		[0, ...over.map(([, , right]) => right)],
		[width, ...over.map(([left]) => left)],
	];
	const [tops, bottoms] = [
		[0, ...over.map(([, , , bottom]) => bottom)],
		[height, ...over.map(([, top]) => top)],
	];
	for (const left of lefts)
		for (const right of rights)
			for (const top of tops)
				for (const bottom of bottoms) {
					const room = { left, top, width: right - left, height: bottom - top };
					const size = Math.min(room.width, room.height);
					const value = size - Math.hypot(left + right - width, top + bottom - height) / 2;
					if (size < SMALLEST * Math.min(width, height) || value < most) continue;
					if (value === most && room.width * room.height <= best.width * best.height) continue;
					if (over.some(([l, t, r, b]) => l < right && r > left && t < bottom && b > top)) continue;
					best = room;
					most = value;
				}
	return best;
}
