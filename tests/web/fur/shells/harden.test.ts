import { ShaderMaterial } from 'three';
import { expect, it } from 'vitest';
import { harden } from '../../../../web/fur/shells/parts/regionUniforms.ts';

/** Hardness of a border whose cells are so wide on screen, pixels. */
function hardness(cell: number): number {
	const uniforms = { cellTexels: { value: 4 }, hardness: { value: 0 } };
	harden(new ShaderMaterial({ uniforms }), cell / 4);
	return uniforms.hardness.value;
}

it('furs are mixed where cells are smaller than pixels, and told apart where they are not', () => {
	for (const cell of [1e-6, 0.1, 0.6]) expect(hardness(cell)).toBe(1);
	for (const cell of [2, 10, 1e6]) expect(hardness(cell)).toBeGreaterThan(100);
	expect(hardness(1)).toBeCloseTo(2);
	const rising = [0.5, 0.7, 0.9, 1.1, 1.3, 1.5, 1.7, 1.9].map(hardness);
	expect(rising).toEqual([...rising].sort((a, b) => a - b));
});

it('a body in one fur has no border', () => {
	expect(() => harden(new ShaderMaterial(), 1)).not.toThrow();
});
