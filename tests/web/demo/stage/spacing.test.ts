import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { Spacing } from '../../../../web/demo/stage/spacing.ts';

beforeEach(() => void vi.stubGlobal('devicePixelRatio', 1));
afterEach(() => void vi.unstubAllGlobals());

/** Shares of merging in the frames at 60 a second until it stands. */
function shares(spacing: Spacing, merging: 0 | 1, most = 100): number[] {
	const found: number[] = [];
	for (let on = true; on && found.length < most; found.push(spacing.merging))
		on = spacing.glide({ coarseness: 1, merging }, 1 / 60);
	return found;
}

it('goes over in small even steps, and turns back from where it is', () => {
	const spacing = new Spacing();
	const there = [0, ...shares(spacing, 1)];
	const steps = there.slice(1).map((share, i) => share - (there[i] as number));
	expect(Math.max(...steps)).toBeLessThan(1 / 23);
	expect(there.at(-1)).toBe(1);
	expect(spacing.glide({ coarseness: 1, merging: 1 }, 1 / 60)).toBe(false);
	shares(spacing, 0, 6);
	expect(spacing.merging).toBeCloseTo(0.75);
	expect(Math.min(...shares(spacing, 1))).toBeGreaterThan(0.75);
	expect(spacing.merging).toBe(1);
});

it('takes a long frame as far as it goes, no further', () => {
	const spacing = new Spacing();
	expect(spacing.glide({ coarseness: 1, merging: 1 }, 5)).toBe(false);
	expect(spacing.merging).toBe(1);
});

it('lets shells be finer where pixels are large', () => {
	const fine = { coarseness: 2 / 3, merging: 0 };
	const spacing = new Spacing();
	spacing.glide(fine, 1 / 60);
	expect(spacing.coarseness).toBe(2 / 3);
	vi.stubGlobal('devicePixelRatio', 2);
	spacing.glide(fine, 1 / 60);
	expect(spacing.coarseness).toBe(1);
});
