import { Box3, Object3D, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { stand } from '../../../../web/demo/stage/stand.ts';

/** Whose box has its foot at (1, 2, 3). */
function body(height: number) {
	const box = new Box3(new Vector3(0, 2, 2), new Vector3(2, 2 + height, 4));
	return { object: new Object3D(), box, radius: box.getSize(new Vector3()).length() / 2 };
}

describe.each([4, 0.1, 0])('a body of height %d', (height) => {
	it('stays as it is where it is not moved', () => {
		const still = body(height);
		stand(still, new Vector3(), 0);
		expect(still.object.matrixWorld.equals(new Object3D().matrixWorld)).toBe(true);
	});

	it('leans to where it is drawn, about its foot, and turns about it', () => {
		const moved = body(height);
		stand(moved, new Vector3(0.5, 0.1, 0), 1);
		const { matrixWorld } = moved.object;
		const foot = new Vector3(1, 2, 3).applyMatrix4(matrixWorld);
		expect(foot.toArray()).toEqual([1.5, 2.1, 3].map((value) => expect.closeTo(value, 6)));
		const up = new Vector3(0, 1, 0).transformDirection(matrixWorld);
		expect(up.x).toBeGreaterThan(0.1);
		expect(up.x, 'and does not topple').toBeLessThan(0.5);
		expect(up.z).toBeCloseTo(0, 6);
	});
});
