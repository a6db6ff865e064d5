import { Group, Mesh, MeshBasicMaterial, PerspectiveCamera, SphereGeometry, Vector2 } from 'three';
import { describe, expect, it } from 'vitest';
import { Brush } from '../../../../web/demo/hands/brush.ts';

const camera = new PerspectiveCamera(40, 1);
camera.position.z = 10;
camera.updateMatrixWorld();

/** A ball of radius 1 whose node is moved and turned. */
const skin = new Group().add(new Mesh(new SphereGeometry(1, 64, 32), new MeshBasicMaterial()));
skin.position.set(0.5, 0, 0);
skin.rotation.set(0.4, 0.3, 0.2);
skin.updateMatrixWorld();

describe('a brush', () => {
	it('is where the pointer’s ray meets the skin, upright on it', () => {
		const brush = new Brush();
		expect(brush.aim(new Vector2(0, 0), camera, skin)).toBe(true);
		const depth = Math.sqrt(1 - 0.5 ** 2);
		expect(brush.place.toArray()).toEqual([0, 0, depth].map((value) => expect.closeTo(value, 2)));
		expect(brush.normal.toArray()).toEqual([-0.5, 0, depth].map((value) => expect.closeTo(value, 2)));
		brush.lie(0.2, 0.1);
		expect(brush.position.clone().sub(brush.place).dot(brush.normal)).toBeCloseTo(0.1, 6);
		expect(brush.scale.x).toBe(0.2);
	});

	it('is nowhere beside it', () => {
		expect(new Brush().aim(new Vector2(0.9, 0), camera, skin)).toBe(false);
	});
});
