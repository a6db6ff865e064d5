import { describe, expect, it } from 'vitest';
import { shellParameters } from '../../web/fur/shells.ts';

const drift = [0.01, 0.05, 0.12, 0.2].map((v): [number, number] => [0, v]);
const all = (count: number) => Array.from({ length: count }, (_, i) => shellParameters(i, count, drift));

describe('shellParameters', () => {
	it('shows every slab unsheared where there are as many shells as slabs', () => {
		all(4).forEach(([s, slab, u, v], k) => {
			expect([s, slab]).toEqual([(k + 0.5) / 4, k]);
			expect([u, v]).toEqual([expect.closeTo(0), expect.closeTo(0)]);
		});
	});

	it.each([1, 3, 4, 7, 48, 256])('covers the fur from skin to tip, inside out, with %i shells', (count) => {
		const shells = all(count);
		const heights = shells.map(([s]) => s ?? 0);
		expect(heights).toEqual([...heights].sort((a, b) => a - b));
		for (const [s = -1, slab = -1] of shells) {
			expect(s).toBeGreaterThan(0);
			expect(s).toBeLessThan(1);
			expect(slab).toBe(Math.floor(s * 4));
		}
	});

	it('lets hairs run on between slabs: look-up plus drift of the slab is the drift at the height', () => {
		const [, slab = 0, , shear = 0] = shellParameters(5, 12, drift); // s = 11/24, between slabs 1 and 2
		expect(slab).toBe(1);
		const expected = 0.05 + ((11 / 24 - 1.5 / 4) / (1 / 4)) * (0.12 - 0.05);
		expect((drift[1]?.[1] ?? 0) + shear).toBeCloseTo(expected, 12);
	});

	it('starts at the root and runs on beyond the last slab', () => {
		const fine = all(256);
		expect((fine[0]?.[3] ?? 0) + 0.01).toBeCloseTo((0.01 * (0.5 / 256)) / (0.5 / 4), 12);
		expect((fine[255]?.[3] ?? 0) + 0.2).toBeGreaterThan(0.22);
	});
});
