import { BufferAttribute, BufferGeometry, Color, Mesh, MeshStandardMaterial } from 'three';
import { describe, expect, it } from 'vitest';
import { furCover, shadeSkin } from '../../web/fur/skin.ts';

const attribute = (size: number, values: number[][]) => new BufferAttribute(new Float32Array(values.flat()), size);
const points = (...xs: number[]) =>
	new BufferGeometry().setAttribute(
		'position',
		attribute(
			3,
			xs.map((x) => [x, 0, 0]),
		),
	);
const shells = (...vertices: { x: number; weight?: number; length?: number }[]) =>
	points(...vertices.map(({ x }) => x)).setAttribute(
		'_fur',
		attribute(
			4,
			vertices.map(({ weight = 1, length = 1 }) => [weight, length, 1, 0]),
		),
	);

describe('furCover', () => {
	it('adds up the copies of a vertex; what no shell stands on is bare', () => {
		const fur = shells({ x: 0, weight: 0.25 }, { x: 0, weight: 0.75 }, { x: 1, weight: 0.5 }, { x: 2, length: 0 });
		expect([...(furCover(points(0, 1, 2, 3), fur) ?? [])]).toEqual([1, 0.5, 0, 0]);
	});

	it('is nothing to speak of where fur is all over, or stands on another surface', () => {
		expect(furCover(points(0, 1), shells({ x: 0 }, { x: 1, length: 0.5 }))).toBeUndefined();
		expect(furCover(points(0, 1), points(1, 0))).toBeUndefined();
		expect(furCover(points(0, 1), shells({ x: 0.5 }))).toBeUndefined();
	});
});

describe('shadeSkin', () => {
	it('darkens the whole material where all is under fur', () => {
		const own = new MeshStandardMaterial({ color: new Color(0.5, 1, 1) });
		const piece = new Mesh(points(0, 1), own);
		const dark = shadeSkin(piece, new Color(0.1, 0.2, 0.3), undefined);
		expect(piece.material).toBe(dark);
		expect((dark as MeshStandardMaterial).color.toArray()).toEqual([0.05, 0.2, 0.3].map((c) => expect.closeTo(c)));
		expect(own.color.r).toBeCloseTo(0.5);
	});

	it('leaves bare vertices their own colour', () => {
		const geometry = points(0, 1, 2).setAttribute(
			'color',
			attribute(4, [
				[1, 1, 1, 1],
				[0.5, 1, 1, 1],
				[0.5, 1, 1, 1],
			]),
		);
		const piece = new Mesh(geometry, new MeshStandardMaterial({ vertexColors: true }));
		shadeSkin(piece, new Color(0.1, 0.2, 0.3), new Float32Array([1, 0, 0.5]));
		expect([...geometry.getAttribute('color').array]).toEqual(
			[0.1, 0.2, 0.3, 0.5, 1, 1, 0.275, 0.6, 0.65].map((c) => expect.closeTo(c)),
		);
		expect((piece.material as MeshStandardMaterial).vertexColors).toBe(true);
	});
});
