import { Vector3, type Vector4 } from 'three';
import { describe, expect, it } from 'vitest';
import { eyeUniforms } from '../../web/fur/eye.ts';

describe('eyeUniforms', () => {
	it('puts four numbers in a vector, row after row', () => {
		const eye = [0, 1, 2].map((row) => Array.from({ length: 12 }, (_, i) => 12 * row + i));
		const uniforms = eyeUniforms({ eye, surge: [0.3, 0.2, 0.1] });
		const vectors = uniforms.eye?.value as Vector4[];
		expect(vectors.flatMap((vector) => vector.toArray())).toEqual(eye.flat());
		expect(uniforms.surge?.value).toEqual(new Vector3(0.3, 0.2, 0.1));
	});

	it('has no surge where none was baked, and nothing without a law', () => {
		const eye = [0, 1, 2].map(() => new Array<number>(12).fill(0));
		expect(eyeUniforms({ eye }).surge?.value.x).toBe(0);
		expect(eyeUniforms({})).toEqual({});
	});
});
