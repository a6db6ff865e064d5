import { BufferAttribute, BufferGeometry, Triangle, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { everyNth } from '../../../web/measure/bench/tori.ts';

/** A flat lattice, a unit a cell, columns along x and rows along −z, so that its triangles look up. */
function lattice(rows: number, columns: number): BufferGeometry {
	const points = Array.from({ length: (rows + 1) * (columns + 1) }, (_, i) => [
		i % (columns + 1),
		0,
		Math.floor(i / (columns + 1)),
	]);
	return new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(points.flat()), 3));
}

describe('a coarser torus', () => {
	it('has a sixteenth of the triangles, over the same ground and the same way up', () => {
		const fine = lattice(8, 12);
		const coarse = everyNth(fine, 8, 12, 4);
		const { index } = coarse;
		expect(index?.count).toBe((3 * 2 * 8 * 12) / 16);
		expect(coarse.getAttribute('position')).toBe(fine.getAttribute('position'));
		const corner = (i: number) =>
			new Vector3().fromBufferAttribute(fine.getAttribute('position'), index?.getX(i) ?? -1);
		let area = 0;
		for (let i = 0; i < (index?.count ?? 0); i += 3) {
			const triangle = new Triangle(corner(i), corner(i + 1), corner(i + 2));
			expect(triangle.getArea()).toBe(8);
			expect(triangle.getNormal(new Vector3()).y).toBe(1);
			area += triangle.getArea();
		}
		expect(area).toBe(8 * 12);
	});

	it('is made of a lattice and nothing else', () => {
		expect(() => everyNth(lattice(8, 8), 8, 12, 4)).toThrow(
			'a torus of 8 rows and 12 columns: got 81 vertices, expected 117',
		);
	});
});
