import { expect, it } from 'vitest';
import { Merging } from '../../../../web/demo/stage/merging.ts';

/** Shares of the frames at 60 a second until it stands. */
function shares(merging: Merging, to: 0 | 1, most = 100): number[] {
	const found: number[] = [];
	for (let on = true; on && found.length < most; found.push(merging.share)) on = merging.glide(to, 1 / 60);
	return found;
}

it('goes over in small even steps, and turns back from where it is', () => {
	const merging = new Merging();
	const there = [0, ...shares(merging, 1)];
	const steps = there.slice(1).map((share, i) => share - (there[i] as number));
	expect(Math.max(...steps)).toBeLessThan(1 / 23);
	expect(there.at(-1)).toBe(1);
	expect(merging.glide(1, 1 / 60)).toBe(false);
	shares(merging, 0, 6);
	expect(merging.share).toBeCloseTo(0.75);
	expect(Math.min(...shares(merging, 1))).toBeGreaterThan(0.75);
	expect(merging.share).toBe(1);
});

it('takes a long frame as far as it goes, no further', () => {
	const merging = new Merging();
	expect(merging.glide(1, 5)).toBe(false);
	expect(merging.share).toBe(1);
});
