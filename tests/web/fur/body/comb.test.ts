import { BufferAttribute, BufferGeometry } from 'three';
import { describe, expect, it } from 'vitest';
import { sharedComb } from '../../../../web/fur/body/comb.ts';

describe('sharedComb', () => {
	/** Vertices of normal y, each with its place along x, an angle of its tangent, a handedness and a comb. */
	function surface(...vertices: { x: number; angle: number; w: number; comb: [number, number] }[]): BufferGeometry {
		const attribute = (size: number, values: number[][]) => new BufferAttribute(new Float32Array(values.flat()), size);
		return new BufferGeometry()
			.setAttribute(
				'position',
				attribute(
					3,
					vertices.map(({ x }) => [x, 0, 0]),
				),
			)
			.setAttribute(
				'normal',
				attribute(
					3,
					vertices.map(() => [0, 1, 0]),
				),
			)
			.setAttribute(
				'tangent',
				attribute(
					4,
					vertices.map(({ angle, w }) => [Math.cos(angle), 0, Math.sin(angle), w]),
				),
			)
			.setAttribute(
				'_comb',
				attribute(
					2,
					vertices.map(({ comb }) => comb),
				),
			);
	}
	const rows = (geometry: BufferGeometry) => {
		const { array = [], count = 0 } = sharedComb(geometry) ?? {};
		return Array.from({ length: count }, (_, i) => [...array.slice(i * 3, i * 3 + 3)]);
	};

	it('turns T and B into the axes of the mesh: T = x, N = y, so B = w·N×T = -w·z', () => {
		expect(rows(surface({ x: 0, angle: 0, w: 1, comb: [0.3, 0.4] }))[0]).toEqual(
			[0.3, 0, -0.4].map((c) => expect.closeTo(c)),
		);
		expect(rows(surface({ x: 0, angle: 0, w: -1, comb: [0.3, 0.4] }))[0]).toEqual(
			[0.3, 0, 0.4].map((c) => expect.closeTo(c)),
		);
	});

	it('is the same to the bit for all copies of a vertex, whatever their tangents and rounding', () => {
		const round = (c: number) => Math.round(c * 127) / 127;
		const copies = [0, 0.7, 2.1].map((angle) => {
			// The vector (0.5, 0, -0.2) along this copy's T and B, in bytes.
			const comb: [number, number] = [
				round(0.5 * Math.cos(angle) - 0.2 * Math.sin(angle)),
				round(0.5 * Math.sin(angle) + 0.2 * Math.cos(angle)),
			];
			return { x: 1, angle, w: 1, comb };
		});
		const [a, b, c, other] = rows(surface(...copies, { x: 2, angle: 0, w: 1, comb: [0.1, 0] }));
		expect(b).toEqual(a);
		expect(c).toEqual(a);
		[0.5, 0, -0.2].forEach((wanted, axis) => {
			expect(Math.abs((a?.[axis] ?? Number.NaN) - wanted)).toBeLessThan(0.006);
		});
		expect(other?.[0]).toBeCloseTo(0.1, 6);
	});

	it('is nothing where nothing is combed', () => {
		const geometry = surface({ x: 0, angle: 0, w: 1, comb: [0, 0] });
		geometry.deleteAttribute('_comb');
		expect(sharedComb(geometry)).toBeUndefined();
	});
});
