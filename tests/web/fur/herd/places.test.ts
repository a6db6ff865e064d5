import { describe, expect, it } from 'vitest';
import { Places } from '../../../../web/fur/herd/Places.ts';

/** Matrices of four bodies; all sixteen numbers of one are the same. */
const matrices = Float32Array.from({ length: 64 }, (_, i) => Math.floor(i / 16) + 1);
const first = (places: Places, count: number) => Array.from({ length: count }, (_, i) => places.array[16 * i]);

describe('places', () => {
	it('take their bodies forwards and backwards', () => {
		const places = new Places(4);
		places.put(Uint32Array.of(3, 0, 2), 1, 1, 2, matrices, false);
		expect(first(places, 2)).toEqual([1, 3]);
		places.put(Uint32Array.of(3, 0, 2), 2, -1, 3, matrices, false);
		expect(first(places, 3)).toEqual([3, 1, 4]);
	});

	it('are uploaded where they have changed, and only as far as they are in use', () => {
		const places = new Places(4, 5);
		expect(places.meshPerAttribute).toBe(5);
		const uploads = (drawn: number[], moved = false) => {
			const before = places.version;
			places.put(Uint32Array.from(drawn), 0, 1, drawn.length, matrices, moved);
			return places.version - before;
		};
		expect(uploads([2, 1])).toBe(1);
		expect(places.updateRanges).toEqual([{ start: 0, count: 32 }]);
		expect(uploads([2, 1])).toBe(0);
		expect(uploads([2])).toBe(0);
		expect(uploads([1])).toBe(1);
		expect(uploads([1, 2, 3])).toBe(1);
		expect(places.updateRanges).toEqual([{ start: 0, count: 48 }]);
		expect(uploads([1, 2, 3], true)).toBe(1);
	});
});
