import { describe, expect, it } from 'vitest';
import { freeRoom, type Room } from '../../../web/page/room.ts';

const rectangle = (left: number, top: number, width: number, height: number): Room => ({ left, top, width, height });
/** Sums of sides are rounded. */
const ROUNDED = 1e-9;
const apart = (a: Room, b: Room) =>
	a.left + a.width <= b.left + ROUNDED ||
	b.left + b.width <= a.left + ROUNDED ||
	a.top + a.height <= b.top + ROUNDED ||
	b.top + b.height <= a.top + ROUNDED;

const header = rectangle(16, 12, 400, 44);

describe('the room that covers leave of a picture', () => {
	it('is all of it where nothing lies over it', () => {
		expect(freeRoom(900, 600, [])).toEqual(rectangle(0, 0, 900, 600));
		// Beside the picture, at its edge, or empty.
		const none = [rectangle(-50, 0, 40, 40), rectangle(900, 0, 10, 600), rectangle(0, 0, 0, 0)];
		expect(freeRoom(900, 600, none)).toEqual(rectangle(0, 0, 900, 600));
	});

	it('is between header and sheet on a phone', () => {
		expect(freeRoom(390, 844, [rectangle(12, 12, 366, 44), rectangle(0, 422, 390, 422)])).toEqual(
			rectangle(0, 56, 390, 366),
		);
	});

	it('is beside panel and tools in a wide window', () => {
		const covers = [header, rectangle(1152, 12, 272, 876), rectangle(16, 300, 58, 300)];
		expect(freeRoom(1440, 900, covers)).toEqual(rectangle(74, 56, 1078, 844));
	});

	it('keeps to the middle where only corners are covered', () => {
		const closed = rectangle(1308, 12, 116, 44);
		expect(freeRoom(1440, 900, [header, closed])).toEqual(rectangle(0, 56, 1440, 844));
	});

	it('has the larger area of two that hold the same circle', () => {
		// Beside the cover 200 × 300 are left, below it 400 × 200.
		expect(freeRoom(400, 300, [rectangle(0, 0, 200, 100)])).toEqual(rectangle(0, 100, 400, 200));
	});

	it('meets no cover, wherever they lie', () => {
		for (let i = 0; i < 200; i++) {
			const at = (n: number) => Math.abs(Math.sin(i * 12.9898 + n * 78.233)) % 1;
			const covers = [0, 1, 2, 3].map((n) =>
				rectangle(700 * at(4 * n) - 50, 500 * at(4 * n + 1) - 50, 300 * at(4 * n + 2), 200 * at(4 * n + 3)),
			);
			const room = freeRoom(700, 500, covers);
			expect(room.left >= 0 && room.top >= 0 && room.left + room.width <= 700 && room.top + room.height <= 500).toBe(
				true,
			);
			const whole = room.width === 700 && room.height === 500;
			if (!whole) for (const cover of covers) expect(apart(room, cover)).toBe(true);
		}
	});

	it('is all of it where they leave next to nothing', () => {
		expect(freeRoom(240, 180, [rectangle(0, 0, 240, 80), rectangle(0, 120, 240, 60)])).toEqual(
			rectangle(0, 0, 240, 180),
		);
	});
});
