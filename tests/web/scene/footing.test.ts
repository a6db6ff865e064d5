/** The ground is where the hairs under the feet are, not where the longest hairs would be. */

import { Box3, BufferAttribute, BufferGeometry, Group, Mesh, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { Fur } from '../../../web/fur/index.ts';
import { footing } from '../../../web/scene/footing.ts';

const box = new Box3(new Vector3(-1, 0, -1), new Vector3(1, 2, 1));

/** @param shares of the longest fur, 0.4, at a foot at height 0 and at a belly at 0.1 */
function body(shares?: [foot: number, belly: number]) {
	const geometry = new BufferGeometry();
	geometry.setAttribute('position', new BufferAttribute(new Float32Array([0, 0, 0, 0.5, 0.05, 0]), 3));
	if (shares) {
		const fur = shares.flatMap((share) => [1, share, 1, 0]);
		geometry.setAttribute('_fur', new BufferAttribute(new Float32Array(fur), 4));
	}
	// Stored at half its size, as quantised positions are.
	const shells = Object.assign(new Mesh(geometry), { furLength: 0.4 });
	shells.scale.setScalar(2);
	const object = new Group().add(shells);
	object.position.set(0, 7, 0);
	return { object, box, fur: { shells } as unknown as Fur };
}

describe('the ground below a body', () => {
	it('takes half of the hairs under the feet', () => {
		expect(footing(body([0.25, 0.25]))).toBeCloseTo(-0.05);
		expect(footing(body())).toBeCloseTo(-0.2);
	});

	it('is below a belly whose fur hangs lower than the feet', () => {
		expect(footing(body([0.1, 1]))).toBeCloseTo(-0.1);
	});

	it('is the lowest point of a body without fur', () => {
		expect(footing({ ...body(), fur: undefined })).toBe(0);
	});
});
