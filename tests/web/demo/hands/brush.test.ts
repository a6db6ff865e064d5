import {
	Bone,
	BoxGeometry,
	Float32BufferAttribute,
	Group,
	Mesh,
	MeshBasicMaterial,
	PerspectiveCamera,
	Skeleton,
	SkinnedMesh,
	SphereGeometry,
	Uint16BufferAttribute,
	Vector2,
} from 'three';
import { describe, expect, it } from 'vitest';
import { Brush } from '../../../../web/demo/hands/brush.ts';
import { restPoint } from '../../../../web/fur/body/joints/restPoint.ts';

const camera = new PerspectiveCamera(40, 1);
camera.position.z = 10;
camera.updateMatrixWorld();

/** A ball of radius 1 whose node is moved and turned. */
const skin = new Group().add(new Mesh(new SphereGeometry(1, 64, 32), new MeshBasicMaterial()));
skin.position.set(0.5, 0, 0);
skin.rotation.set(0.4, 0.3, 0.2);
skin.updateMatrixWorld();
const body = { skin, restPoint };

describe('a brush', () => {
	it('is where the pointer’s ray meets the skin, upright on it', () => {
		const brush = new Brush();
		expect(brush.aim(new Vector2(0, 0), camera, body)).toBe(true);
		const depth = Math.sqrt(1 - 0.5 ** 2);
		expect(brush.place.toArray()).toEqual([0, 0, depth].map((value) => expect.closeTo(value, 2)));
		expect(brush.normal.toArray()).toEqual([-0.5, 0, depth].map((value) => expect.closeTo(value, 2)));
		brush.lie(0.2, 0.1);
		expect(brush.position.clone().sub(brush.place).dot(brush.normal)).toBeCloseTo(0.1, 6);
		expect(brush.scale.x).toBe(0.2);
	});

	it('is nowhere beside it', () => {
		expect(new Brush().aim(new Vector2(0.9, 0), camera, body)).toBe(false);
	});

	it('knows where its place is on a body at rest that a joint has carried away', () => {
		const box = new BoxGeometry(1, 1, 1);
		const { count } = box.getAttribute('position');
		box.setAttribute('skinIndex', new Uint16BufferAttribute(new Uint16Array(4 * count), 4));
		const weights = Array.from({ length: count }, () => [1, 0, 0, 0]).flat();
		box.setAttribute('skinWeight', new Float32BufferAttribute(weights, 4));
		const posed = new SkinnedMesh(box, new MeshBasicMaterial());
		const bone = new Bone();
		const scene = new Group().add(posed, bone);
		scene.position.set(0, 0.2, 0);
		scene.updateMatrixWorld(true);
		posed.bind(new Skeleton([bone]));
		bone.position.x = 2;
		bone.rotation.z = Math.PI / 2;
		scene.updateMatrixWorld(true);
		const brush = new Brush();
		// Right of its middle and above: 0.1 to the right and 0.3 up, turned back 0.3 to the right and 0.1 down.
		const aim = new Vector2(2.1, 0.5).divideScalar((10 - 0.5) * Math.tan((20 * Math.PI) / 180));
		expect(brush.aim(aim, camera, { skin: posed, restPoint })).toBe(true);
		expect(brush.place.toArray()).toEqual([2.1, 0.5, 0.5].map((value) => expect.closeTo(value, 5)));
		expect(brush.rest.toArray()).toEqual([0.3, 0.1, 0.5].map((value) => expect.closeTo(value, 5)));
		expect(brush.normal.toArray()).toEqual([0, 0, 1].map((value) => expect.closeTo(value, 5)));
	});
});
