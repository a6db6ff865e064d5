import type { Vector4 } from 'three';
import { describe, expect, it } from 'vitest';
import { eyeUniforms, surgeShare } from '../../../../web/fur/light/eye.ts';

describe('eyeUniforms', () => {
	it('puts four numbers in a vector, row after row', () => {
		const eye = [0, 1, 2].map((row) => Array.from({ length: 16 }, (_, i) => 16 * row + i));
		const uniforms = eyeUniforms([{ eye, surge: [0.3, 0.2, 0.1] }]);
		const vectors = uniforms.eye?.value as Vector4[];
		expect(vectors.flatMap((vector) => vector.toArray())).toEqual(eye.flat());
		expect(uniforms.surge?.value.toArray()).toEqual([0.3, 0.2, 0.1, surgeShare(0.1)]);
	});

	it('reads terms that are missing as 0, of shells and fins', () => {
		const eye = [0, 1, 2].map((row) => Array.from({ length: 12 }, (_, i) => 1 + 12 * row + i));
		const { finEye } = eyeUniforms([{ eye, finEye: eye }]);
		const vectors = finEye?.value as Vector4[];
		expect(vectors.flatMap((vector) => vector.toArray())).toEqual(eye.flatMap((row) => [...row, 0, 0, 0, 0]));
		expect(eyeUniforms([{ eye }]).finEye).toBeUndefined();
	});

	it("knows the surge's share of a half sphere", () => {
		for (const width of [0.05, 0.4]) {
			const steps = 20000;
			let mean = 0;
			// Heights of lights over the plane across the eye's direction: as many of each.
			for (let i = 0; i < steps; i++) mean += 1 / (1 + (2 - (2 * (i + 0.5)) / steps) / width ** 2) / steps;
			expect(surgeShare(width)).toBeCloseTo(mean, 5);
		}
	});

	it('has no surge where none was baked, and nothing without a law', () => {
		const eye = [0, 1, 2].map(() => new Array<number>(16).fill(0));
		expect(eyeUniforms([{ eye }]).surge?.value.x).toBe(0);
		expect(eyeUniforms([{}])).toEqual({});
	});
});
