import { describe, expect, it } from 'vitest';
import { scatter, spread } from '../../../../web/demo/stage/crowd.ts';

describe('a crowd', () => {
	const spots = scatter(400);

	it('has the model itself in its middle, and nobody moves when others come', () => {
		expect(spots).toHaveLength(400);
		expect(spots[0]).toEqual({ x: 0, z: 0, yaw: 0, size: 1 });
		expect(scatter(57)).toEqual(spots.slice(0, 57));
		expect(scatter(57, 8)).not.toEqual(spots.slice(0, 57));
	});

	it.each([10, 100, 400])('of %i stands side by side on the ground that it has', (count) => {
		const some = spots.slice(0, count);
		const nearest = some.map((a) =>
			Math.min(...some.filter((b) => b !== a).map((b) => Math.hypot(a.x - b.x, a.z - b.z))),
		);
		expect(Math.min(...nearest)).toBeGreaterThan(0.8);
		// Bodies thrown at random have their nearest at half the distance of a lattice, and a half of that varies.
		const mean = nearest.reduce((sum, away) => sum + away, 0) / count;
		expect(mean).toBeGreaterThan(0.65 * Math.sqrt(((2 / Math.sqrt(3)) * (Math.PI * spread(count) ** 2)) / count));
		for (const { x, z } of some) expect(Math.hypot(x, z)).toBeLessThanOrEqual(spread(count));
	});

	it('is turned all ways and of many sizes', () => {
		const quarters = [0, 1, 2, 3].map((quarter) =>
			spots.filter(({ yaw }) => Math.floor((yaw / Math.PI) * 2) === quarter),
		);
		for (const some of quarters) expect(some.length).toBeGreaterThan(70);
		const sizes = spots.map(({ size }) => size);
		expect([Math.min(...sizes) > 0.79, Math.max(...sizes) < 1.16]).toEqual([true, true]);
		expect(Math.max(...sizes) - Math.min(...sizes)).toBeGreaterThan(0.3);
	});
});
