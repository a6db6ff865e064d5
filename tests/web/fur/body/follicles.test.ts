import { BufferAttribute, BufferGeometry, SphereGeometry } from 'three';
import { describe, expect, it } from 'vitest';
import { FOLLICLES_PER_ROW, FurFollicles } from '../../../../web/fur/body/FurFollicles.ts';

const attribute = (size: number, values: number[][]) => new BufferAttribute(new Float32Array(values.flat()), size);

/** Corners of normal y, with the share of the longest fur and a comb in the mesh's own axes. */
function surface(corners: [x: number, y: number, z: number][], triangles: number[]): BufferGeometry {
	const rows = (row: (x: number) => number[]) =>
		attribute(
			row(0).length,
			corners.map(([x]) => row(x)),
		);
	return new BufferGeometry()
		.setAttribute('position', attribute(3, corners))
		.setAttribute(
			'normal',
			rows(() => [0, 2, 0]),
		)
		.setAttribute(
			'_fur',
			rows((x) => [1, 0.1 * x, 1, 0]),
		)
		.setAttribute(
			'_comb',
			rows((x) => [0.2 * x, 0, 0]),
		)
		.setIndex(triangles);
}

/** Two patches of a triangle each that share the edge from (1, 0, 0) to (0, 0, 1), its ends copied. */
const patches = () =>
	surface(
		[
			[0, 0, 0],
			[1, 0, 0],
			[0, 0, 1],
			[1, 0, 0],
			[0, 0, 1],
			[1, 0, 1],
		],
		[0, 2, 1, 3, 4, 5],
	);

const linked = ({ first, links }: FurFollicles, i: number) => [...links.subarray(first[i], first[i + 1])];

describe('FurFollicles', () => {
	it('are the vertices without their copies', () => {
		const follicles = FurFollicles.of(patches());
		expect(follicles.count).toBe(4);
		expect([...follicles.position]).toEqual([0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1]);
		expect([...follicles.normal.subarray(0, 3)]).toEqual([0, 1, 0]);
		expect(follicles.length[1]).toBeCloseTo(0.1);
		expect(follicles.comb[3]).toBeCloseTo(0.2);
	});

	it('are linked along the edges of all patches, both ways, once', () => {
		const follicles = FurFollicles.of(patches());
		expect([0, 1, 2, 3].map((i) => linked(follicles, i))).toEqual([
			[1, 2],
			[0, 2, 3],
			[0, 1, 3],
			[1, 2],
		]);
		expect(follicles.links.length).toBe(10);
		expect(follicles.first[4]).toBe(10);
	});

	it('know no link of a triangle that has shrunk to an edge with itself', () => {
		const follicles = FurFollicles.of(
			surface(
				[
					[0, 0, 0],
					[0, 0, 0],
					[1, 0, 0],
				],
				[0, 1, 2],
			),
		);
		expect([0, 1].map((i) => linked(follicles, i))).toEqual([[1], [0]]);
	});

	it('are straight, of full length and linked by threes where the surface says nothing of it', () => {
		const sphere = new SphereGeometry(1, 8, 6).toNonIndexed();
		const follicles = FurFollicles.of(sphere);
		expect(new Set(follicles.length)).toEqual(new Set([1]));
		expect(new Set(follicles.comb)).toEqual(new Set([0]));
		for (let i = 0; i < follicles.count; i++) expect(linked(follicles, i).length).toBeGreaterThanOrEqual(2);
	});

	it('are the same for all geometries that have the positions in common', () => {
		const body = patches();
		const dressed = new BufferGeometry();
		for (const [name, values] of Object.entries(body.attributes)) dressed.setAttribute(name, values);
		const follicles = FurFollicles.of(body);
		expect(FurFollicles.of(dressed)).toBe(follicles);
		expect(FurFollicles.of(patches())).not.toBe(follicles);
		for (const geometry of [body, dressed]) follicles.mark(geometry);
		expect([...body.getAttribute('follicle').array]).toEqual([0, 1, 2, 1, 2, 3]);
		expect(dressed.getAttribute('follicle')).toBe(body.getAttribute('follicle'));
	});

	it('are found for other vertices by their place, of two at one place by the normal', () => {
		const body = patches();
		// A sharp edge: the second copies lean away.
		body.getAttribute('normal').setXYZ(3, 1, 0, 0);
		body.getAttribute('normal').setXYZ(4, 1, 0, 0);
		const follicles = FurFollicles.of(body);
		expect(follicles.count).toBe(6);
		const quads = surface(
			[
				[1, 0, 0],
				[1, 0, 0],
				[0.1, 0.3, 0.1],
				[9, 9, 9],
			],
			[],
		);
		quads.getAttribute('normal').setXYZ(1, 0.9, 0.1, 0);
		follicles.mark(quads);
		expect([...quads.getAttribute('follicle').array]).toEqual([1, 3, 0, 5]);
	});

	it('are found among many, as by trying all', () => {
		const follicles = FurFollicles.of(new SphereGeometry(1, 40, 30));
		const other = new SphereGeometry(1.02, 23, 17);
		follicles.mark(other);
		const [position, mark] = [other.getAttribute('position'), other.getAttribute('follicle')];
		for (let i = 0; i < position.count; i++) {
			const away = (at: number) =>
				Math.hypot(
					...['getX', 'getY', 'getZ'].map(
						(get, axis) => position[get as 'getX'](i) - (follicles.position[3 * at + axis] ?? Number.POSITIVE_INFINITY),
					),
				);
			const least = Math.min(...Array.from({ length: follicles.count }, (_, at) => away(at)));
			expect(away(mark.getX(i))).toBeCloseTo(least, 6);
		}
		expect(FOLLICLES_PER_ROW).toBe(256);
	});
});
