import { describe, expect, it } from 'vitest';
import { median, perRound, ratio, thereAndBack } from '../../../web/measure/statistics.ts';

describe('the median', () => {
	it('is the middle, or the mean of the two, whatever their order', () => {
		expect(median([3, 1, 2])).toBe(2);
		expect(median([4, 1, 3, 2])).toBe(2.5);
		expect(median([7])).toBe(7);
		expect(median([])).toBeNaN();
	});

	it('leaves its values as they are', () => {
		const values = [3, 1, 2];
		median(values);
		expect(values).toEqual([3, 1, 2]);
	});
});

describe('rivals in turn', () => {
	it('go there and back', () => {
		expect(thereAndBack(['A', 'B', 'C']).join('')).toBe('ABCCBA');
	});

	/** Times of rivals on a machine that gets slower by `drift` milliseconds with every turn. */
	function contest(costs: number[], rounds: number, drift: number): number[][] {
		const turns: number[][] = costs.map(() => []);
		let now = 0;
		for (let round = 0; round < rounds; round++) {
			for (const rival of thereAndBack([...costs.keys()])) turns[rival]?.push((costs[rival] ?? 0) + drift * now++);
		}
		return turns.map(perRound);
	}

	it('are told apart on a machine that gets slower and slower', () => {
		const [a = [], b = [], c = []] = contest([10, 10, 10], 5, 3);
		expect(a).toHaveLength(5);
		expect(ratio(b, a)).toBe(1);
		expect(ratio(c, a)).toBe(1);
		const [first = [], last = []] = contest([10, 20], 3, 0.01);
		expect(ratio(last, first)).toBeCloseTo(2, 1);
	});

	it('are not judged by one bad round', () => {
		expect(ratio([2, 2, 50, 2, 2], [1, 1, 1, 1, 1])).toBe(2);
		// A round that was slow for both counts as any other.
		expect(ratio([2, 20, 2], [1, 10, 1])).toBe(2);
	});

	it('have no ratio to one that was not there', () => {
		expect(ratio([1, 2], [])).toBeNaN();
	});
});
