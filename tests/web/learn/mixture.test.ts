import { describe, expect, it } from 'vitest';
import { mixtureOf } from '../../../web/learn/wet/mixture.ts';

const WETNESSES = [0, 0.25, 0.5, 0.75, 1];

describe('what a wetness is mixed of', () => {
	it.each([
		[0, 0, 0],
		[0.1, 0, 0.4],
		[0.25, 0, 1],
		[0.6, 2, 0.4],
		[1, 3, 1],
	])('%f lies after state %i, %f of the way to the next', (wetness, drier, share) => {
		const mixture = mixtureOf(WETNESSES, wetness);
		expect(mixture.drier).toBe(drier);
		expect(mixture.share).toBeCloseTo(share, 9);
	});

	it('has the wetness that was asked for', () => {
		for (let wetness = 0; wetness <= 1; wetness += 0.01) {
			const { drier, share } = mixtureOf(WETNESSES, wetness);
			const [from = 0, to = 0] = WETNESSES.slice(drier);
			expect((1 - share) * from + share * to).toBeCloseTo(wetness, 9);
		}
	});

	it('knows of no more than there are: beyond the last it is the last', () => {
		expect(mixtureOf([0, 0.8], 1)).toEqual({ drier: 0, share: 1 });
	});
});
